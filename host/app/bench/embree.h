// Embree, to be measured against: a library of its own, loaded when a benchmark first asks for it, so that
// nothing else starts more slowly for it. Absent where sahl was built without its headers.
#pragma once

#include "bvh/bvh.h"
#include "device/device.h"

#include <memory>
#include <string>

namespace sahl {

/// "3.13.5", or empty where there is none.
std::string embreeVersion();

/// Empty, or why there is no Embree.
std::string whyNoEmbree();

/// A scene of triangles in Embree, with the builder's defaults: fast rather than watertight.
class EmbreeScene {
public:
    virtual ~EmbreeScene() = default;

    /// To build the tree [s].
    virtual double buildSeconds() const = 0;

    /// Single rays on the threads that the scene was made for. Fills number and tHit of the hits; returns
    /// the seconds that it took [s].
    virtual double trace(std::span<const TraceRay> rays, bool anyHit, std::span<TraceHit> hits) const = 0;

    /// One ray, by the thread that calls. False when it meets nothing. `normal`: of any length and side.
    virtual bool meets(const TraceRay& ray, float& tHit, vec3& normal) const = 0;
};

enum class EmbreeBuild { standard, high };

/// Null where there is no Embree. Spheres among the primitives are left out.
std::unique_ptr<EmbreeScene> makeEmbreeScene(std::span<const Primitive> primitives, EmbreeBuild build,
                                             unsigned threads);

/// The tree that Embree's builder of high quality makes, spatial splits included, as nodes of ours: to be
/// counted by our traversal. A triangle that is split is in several leaves. Empty where there is no Embree.
Bvh embreeTree(std::span<const Primitive> primitives, unsigned threads);

}  // namespace sahl
