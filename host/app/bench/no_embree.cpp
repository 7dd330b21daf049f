// Takes the place of embree.cpp in builds without Embree's headers, or with SAHL_WITH_EMBREE=OFF.
#include "app/bench/embree.h"

namespace sahl {

std::string embreeVersion()
{
    return {};
}

std::string whyNoEmbree()
{
    return "this sahl was built without Embree (libembree-dev)";
}

std::unique_ptr<EmbreeScene> makeEmbreeScene(std::span<const Primitive>, EmbreeBuild, unsigned)
{
    return nullptr;
}

Bvh embreeTree(std::span<const Primitive>, unsigned)
{
    return {};
}

}  // namespace sahl
