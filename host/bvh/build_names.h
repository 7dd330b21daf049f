// What ways of building are called in files and messages.
#pragma once

#include "bvh/bvh.h"

namespace sahl {

inline const char* nameOf(BvhBuild build)
{
    switch (build) {
    case BvhBuild::automatic: return "auto";
    case BvhBuild::binned: return "binned";
    case BvhBuild::high: return "high";
    case BvhBuild::sweep: break;
    }
    return "sweep";
}

}  // namespace sahl
