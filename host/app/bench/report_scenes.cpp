#include "app/bench/report_scenes.h"

#include "app/bench/bunnies.h"
#include "scene/primitives.h"
#include "scene/probe.h"

namespace sahl {

const std::vector<BenchScene>& benchScenes()
{
    static const std::vector<BenchScene> scenes = {
        {.name = "teapot",
         .meshes = {"meshes/miro/teapot.obj", "meshes/teapot.obj"},
         .eye = {0, 3, 6},
         .lookAt = {0, 0, 0},
         .fovDeg = 45,
         .light = {10, 10, 10},
         .wattage = 700,
         .floor = 10,
         .report = ReportRow{695, 577, 5845260, 1600870, 0, 5}},
        {.name = "bunny",
         .meshes = {"meshes/miro/bunny.obj", "meshes/bunny.obj"},
         .eye = {0, 5, 15},
         .lookAt = {0, 0, 0},
         .fovDeg = 45,
         .light = {10, 20, 10},
         .wattage = 1000,
         .floor = 100,
         .report = ReportRow{82905, 69452, 1469106, 522947, 45, 26}},
        {.name = "sponza",
         .meshes = {"meshes/miro/sponza.obj", "meshes/sponza.obj"},
         .eye = {8, 1.5, 1},
         .lookAt = {0, 2.5, -1},
         .fovDeg = 55,
         .light = {0, 10, 0},
         .wattage = 200,
         .floor = 0,
         .report = ReportRow{78039, 66454, 44084644, 7376469, 43, 37}},
        {.name = "20 bunnies",
         .meshes = {"meshes/miro/bunny.obj", "meshes/bunny.obj"},
         .eye = {0, 5, 15},
         .lookAt = {0, 0, 0},
         .fovDeg = 45,
         .light = {10, 20, 10},
         .wattage = 1000,
         .floor = 100,
         .instanced = true,
         .report = {}},
        {.name = "dragon",
         .meshes = {"meshes/dragon_vrip.ply.gz", "meshes/dragon.ply.gz"},
         .eye = {0, 0.15, 0.35},
         .lookAt = {0, 0.12, 0},
         .fovDeg = 45,
         .light = {0.25f, 0.5f, 0.25f},
         .wattage = 0.6f,
         .floor = 0,
         .report = {}},
    };
    return scenes;
}

fs::path findMesh(const BenchScene& scene, const std::vector<fs::path>& folders)
{
    for (const std::string& mesh : scene.meshes) {
        for (const fs::path& folder : folders) {
            std::error_code ignored;
            if (fs::is_regular_file(folder / mesh, ignored)) return folder / mesh;
        }
    }
    return std::string(scene.name) == "teapot" ? BUILT_IN : "";
}

namespace {

void addFloor(Scene& scene, float size, uint32_t material)
{
    Mesh floor;
    floor.positions = {{-size, 0, -size}, {0, 0, size}, {size, 0, -size}};
    floor.triangles = {{.position = {0, 1, 2}}};
    appendShape(scene, floor, {}, material, "floor");
}

/// Ours, about as fine and as large as the benchmark's own.
Scene builtInTeapot(uint32_t size)
{
    Scene scene;
    scene.settings.width = scene.settings.height = size;
    scene.settings.spp = 1;
    Transform shrink;
    shrink.linear = glm::dmat3(0.64943);
    appendShape(scene, makeTeapot(3, true), shrink, 0, "teapot");
    return scene;
}

/// Turns the scene's primitives into 20 instances of one object.
void placeBunnies(Scene& scene)
{
    scene.objects = {std::move(scene.primitives)};
    scene.primitives = {};
    scene.objectStarts = {};
    for (const auto& m : BUNNIES) {
        Placement placement;  // glm's matrices are arrays of columns
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 3; column++)
                placement.linear[column][row] = m[4 * row + column];
            placement.translation[row] = m[4 * row + 3];
        }
        scene.instances.push_back(placement);
    }
}

Light pointLight(const vec3& position, float intensity)
{
    Light light = {};
    light.type = LIGHT_POINT;
    light.position = position;
    light.intensity = vec3(intensity);
    return light;
}

}  // namespace

Scene makeBenchScene(const BenchScene& described, const fs::path& mesh, uint32_t size)
{
    SceneOptions options;
    options.width = options.height = size;
    options.spp = 1;
    Scene scene = mesh == BUILT_IN ? builtInTeapot(size) : loadScene(mesh, options);
    scene.name = described.name;
    scene.settings.integrator = INTEGRATOR_PHONG;
    scene.settings.jitter = false;
    const uint32_t white = addMaterial(scene, "white", vec3(1.0f));
    for (Primitive& primitive : scene.primitives) primitive.material = white;
    if (described.instanced) placeBunnies(scene);
    if (described.floor > 0) addFloor(scene, described.floor, white);
    setProbe(scene, {1, 1, {0, 0, 0}}, PROBE_LATLONG, FILTER_NEAREST, "black");
    scene.lights = {pointLight(described.light, described.wattage)};
    CameraDescription camera;
    camera.eye = described.eye;
    camera.lookAt = described.lookAt;
    camera.fovDeg = described.fovDeg;
    scene.camera = makeCamera(camera, size, size);
    return scene;
}

}  // namespace sahl
