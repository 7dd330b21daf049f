// Scenes for instances: all that is seen stands in an object's own space.
#include "oracle/terms.h"
#include "oracle/terms_parts.h"

namespace sahl::testing {
namespace {

/// Makes all shapes of the scene so far an object.
uint shareShapes(Scene& scene)
{
    scene.objects.push_back(std::move(scene.primitives));
    scene.primitives.clear();
    scene.objectStarts.clear();
    return static_cast<uint>(scene.objects.size() - 1);
}

void place(Scene& scene, uint object, const Transform& transform)
{
    Placement placement;
    placement.linear = transform.linear;
    placement.translation = transform.translation;
    placement.object = object;
    scene.instances.push_back(placement);
}

/// A cup of five sides and a ball in it: sheared, mirrored, and turned by instances that see one
/// another.
Scene instances()
{
    Scene scene = scene32(3);
    addMaterialOf(scene, MATERIAL_LAMBERT, {0.8f, 0.7f, 0.5f});
    appendShape(scene, makeSphere({0, 0, 0}, 0.6, 0, true), {}, 0, "ball");
    addRectangle(scene, {-1, -0.7, -1}, {0, 0, 2}, {2, 0, 0});
    addRectangle(scene, {-1, -0.7, -1}, {2, 0, 0}, {0, 1, 0});
    const uint cup = shareShapes(scene);
    addSphere(scene, {0, 0, 0}, 0.5f);
    const uint ball = shareShapes(scene);
    Transform shear;
    shear.linear = {{0.9, 0.1, 0}, {0.3, 0.7, 0.2}, {0, -0.1, 1.1}};
    shear.translation = {-0.8, 0, 0};
    place(scene, cup, shear);
    const Transform mirrored = compose(rotation({0, 1, 0}, 25), scaling({-0.7, 1.3, 0.8}));
    place(scene, cup, compose(translation({1.1, 0, -0.3}), mirrored));
    const Transform flat = compose(rotation({1, 0, 1}, 40), scaling({1.2, 0.4, -0.8}));
    place(scene, ball, compose(translation({0.2, 0.7, 0.9}), flat));
    setSky(scene);
    lookFrom(scene, {0.3, 1.5, 5}, {0.1, 0.1, 0}, 38);
    return scene;
}

void scaleInstances(Scene& scene, float by)
{
    for (Placement& placement : scene.instances) placement.linear *= 1 + double{by};
}

/// Two instances of a glass ball, flattened and mirrored, before a bright sky: where the light goes
/// is decided by the normals of ellipsoids.
Scene ellipsoids()
{
    Scene scene = scene32(4);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.5f);
    addSphere(scene, {0.1f, 0, 0}, 1);
    const uint ball = shareShapes(scene);
    place(scene, ball,
          compose(translation({-0.6, 0, 0}),
                  compose(rotation({0, 0, 1}, 30), scaling({0.5, 1.1, 0.8}))));
    place(scene, ball,
          compose(translation({0.7, 0.1, -0.5}),
                  compose(rotation({1, 1, 0}, 50), scaling({-0.9, 0.6, 0.4}))));
    setSky(scene);
    lookFrom(scene, {0, 0.4, 5}, {0, 0, 0}, 30);
    return scene;
}

}  // namespace

std::vector<Term> instanceTerms()
{
    return {
        {"instances", instances, scaleInstances, "size of the instances"},
        {"ellipsoids", ellipsoids, scaleInstances, "size of the instances"},
    };
}

}  // namespace sahl::testing
