// Pictures made by somebody else's renderer (the course ray tracer miro): camera rays, nearest hits,
// interpolated normals and a point light without shadows must give the same bytes.

#include "scene/mesh.h"
#include "support/render_scenes.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <zlib.h>

#include <cmath>
#include <fstream>
#include <utility>

namespace sahl::testing {
namespace {

constexpr uint32_t SIZE = 512;

/// The pixels of a gzipped binary PPM of 512 x 512.
std::vector<uint8_t> readPpm(const fs::path& path)
{
    gzFile file = gzopen(path.c_str(), "rb");
    std::vector<uint8_t> bytes(SIZE * SIZE * 3 + 64);
    int got = gzread(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(file);
    EXPECT_GE(got, static_cast<int>(SIZE * SIZE * 3));
    bytes.resize(static_cast<size_t>(std::max(got, 0)));
    return {bytes.end() - SIZE * SIZE * 3, bytes.end()};
}

glm::dvec3 vectorOf(const nlohmann::json& json) { return {json[0], json[1], json[2]}; }

/// A gzipped OBJ is unpacked beside the test's other files; others are taken where they are.
fs::path unpacked(const fs::path& path)
{
    if (path.extension() != ".gz") return path;
    static const TemporaryFolder folder;
    fs::path plain = folder.path / path.stem();
    gzFile in = gzopen(path.c_str(), "rb");
    std::ofstream out(plain, std::ios::binary);
    char buffer[1 << 16];
    for (int got; (got = gzread(in, buffer, sizeof buffer)) > 0;) out.write(buffer, got);
    gzclose(in);
    return plain;
}

/// The scene as miro's numbers give it.
Scene miroScene(const nlohmann::json& numbers, const fs::path& mesh)
{
    SceneOptions options = smallPicture(SIZE, SIZE, 1);
    Scene scene = loadScene(unpacked(mesh), options);
    for (Material& material : scene.materials) material.baseColor = vec3(1);
    for (const auto& extra : numbers["extra_triangles"]) {
        Mesh floor;
        for (int i = 0; i < 3; i++) floor.positions.push_back(vec3(vectorOf(extra["vertices"][i])));
        floor.normals.push_back(vec3(vectorOf(extra["normal"])));
        floor.triangles.push_back({{0, 1, 2}, {0, 0, 0}, 0});
        appendShape(scene, floor, {}, 0, "floor");
    }
    const auto& lamp = numbers["point_light"];
    Light light = {};
    light.type = LIGHT_POINT;
    light.position = vec3(vectorOf(lamp["position"]));
    light.intensity = vec3(lamp["wattage"].get<float>());
    scene.lights = {light};
    CameraDescription camera;
    camera.eye = vectorOf(numbers["camera"]["eye"]);
    camera.lookAt = vectorOf(numbers["camera"]["look_at"]);
    camera.fovDeg = numbers["camera"]["vertical_fov_degrees"];
    scene.camera = makeCamera(camera, SIZE, SIZE);
    scene.probe = plainProbe(1, 1, PROBE_LATLONG, FILTER_NEAREST);
    scene.background.reset();
    scene.probeTexels = {vec4(vec3(vectorOf(numbers["background_rgb"])), 0)};
    scene.settings.integrator = INTEGRATOR_PHONG;
    scene.settings.shading = SHADING_DIFFUSE;
    scene.settings.jitter = false;
    return scene;
}

uint8_t byteOf(float value)
{
    return static_cast<uint8_t>(std::min(255.0f, std::floor(255 * value)));
}

struct Case {
    const char* name;
    const char* mesh;
    const char* picture;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class MiroReferences : public ::testing::TestWithParam<Case> {};

TEST_P(MiroReferences, areMetWithinOneByteOnAlmostAllPixels)
{
    const Case& c = GetParam();
    SAHL_REQUIRE_ASSET("scenes/miro_benchmark.json");
    SAHL_REQUIRE_ASSET(c.mesh);
    SAHL_REQUIRE_ASSET(c.picture);
    std::ifstream file(assetFolder() / "scenes/miro_benchmark.json");
    auto numbers = nlohmann::json::parse(file)[c.name];
    PreparedScene scene = prepareScene(miroScene(numbers, assetFolder() / c.mesh), BvhBuild::automatic, 2);
    Image image = meanImage(renderFilm(*makeCpuDevice({}), scene, 0, 1));
    std::vector<uint8_t> expected = readPpm(assetFolder() / c.picture);
    ASSERT_EQ(expected.size(), image.rgb.size());
    size_t near = 0;
    for (size_t pixel = 0; pixel < SIZE * SIZE; pixel++) {
        bool close = true;
        for (size_t k = 3 * pixel; k < 3 * pixel + 3; k++) {
            close = close && std::abs(int(byteOf(image.rgb[k])) - int(expected[k])) <= 1;
        }
        near += close;
    }
    double share = double(near) / (SIZE * SIZE);
    RecordProperty("share", std::to_string(share));
    EXPECT_GE(share, 0.999);
}

glm::dmat3 linearOf(const nlohmann::json& rows)
{
    glm::dmat3 linear;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) linear[column][row] = rows[row][column];
    }
    return linear;
}

/// miro's 20 bunnies as a scene of instances, or of that many meshes.
PreparedScene bunnies(const nlohmann::json& numbers, bool instances)
{
    Scene scene = miroScene(numbers, assetFolder() / "meshes/miro/bunny_smooth.obj.gz");
    // The floor is the last triangle; the bunny before it becomes an object of its own.
    const Primitive floor = scene.primitives.back();
    scene.primitives.pop_back();
    std::vector<Primitive> bunny = std::exchange(scene.primitives, {floor});
    const std::vector<TriangleCorners> normals = scene.triangleCorners;
    for (const auto& rows : numbers["instances_row_major_4x4_column_vectors"]) {
        Placement placement;
        placement.linear = linearOf(rows);
        for (int axis = 0; axis < 3; axis++) placement.translation[axis] = rows[axis][3];
        if (instances) {
            scene.instances.push_back(placement);
            continue;
        }
        Mesh mesh;
        for (const Primitive& t : bunny) {
            const auto corner = static_cast<uint32_t>(mesh.positions.size());
            mesh.positions.insert(mesh.positions.end(), {t.p0, t.p1, t.p2});
            const TriangleCorners& n = normals.at(t.shape);
            mesh.normals.insert(mesh.normals.end(), {n.n0, n.n1, n.n2});
            const std::array<uint32_t, 3> corners = {corner, corner + 1, corner + 2};
            mesh.triangles.push_back({corners, corners, 0});
        }
        appendShape(scene, mesh, {placement.linear, placement.translation}, 0, "bunny");
    }
    for (size_t i = 0; i < scene.primitives.size(); i++)
        scene.primitives[i].number = static_cast<uint>(i);
    if (instances) scene.objects = {std::move(bunny)};
    return prepareScene(std::move(scene), BvhBuild::automatic, 2);
}

/// 20 bunnies through instances look as if each were a mesh of its own, at the memory of one.
TEST(MiroBunnies, areTheSamePictureAsInstancesAndAsMeshes)
{
    SAHL_REQUIRE_ASSET("scenes/miro_benchmark.json");
    SAHL_REQUIRE_ASSET("meshes/miro/bunny_smooth.obj.gz");
    std::ifstream file(assetFolder() / "scenes/miro_benchmark.json");
    const auto numbers = nlohmann::json::parse(file)["bunny20"];
    const auto device = makeCpuDevice({});
    Image pictures[2];
    uint64_t bytes[2];
    for (int i = 0; i < 2; i++) {
        const PreparedScene scene = bunnies(numbers, i == 0);
        EXPECT_EQ(scene.bvh.statistics.primitivesSeen, 1'389'021u);
        EXPECT_EQ(scene.bvh.instances.size(), i == 0 ? 20u : 0u);
        pictures[i] = meanImage(renderFilm(*device, scene, 0, 1));
        bytes[i] = device->statistics().sceneBytes;
    }
    size_t differing = 0;
    for (size_t pixel = 0; pixel < SIZE * SIZE; pixel++) {
        bool near = true;
        for (size_t k = 3 * pixel; k < 3 * pixel + 3; k++) {
            const int one = byteOf(pictures[0].rgb[k]), other = byteOf(pictures[1].rgb[k]);
            near = near && std::abs(one - other) <= 1;
        }
        differing += !near;
    }
    RecordProperty("differing", std::to_string(differing));
    EXPECT_LE(double(differing), 0.001 * SIZE * SIZE);
    EXPECT_LT(bytes[0] * 15, bytes[1]) << "instances do not share what they show";
}

INSTANTIATE_TEST_SUITE_P(
    , MiroReferences,
    ::testing::Values(Case{"teapot", "meshes/miro/teapot.obj", "references/miro/yyang_teaport.ppm.gz"},
                      Case{"bunny", "meshes/miro/bunny_smooth.obj.gz", "references/miro/yyang_bunnysmooth1.ppm.gz"},
                      Case{"sponza", "meshes/miro/sponza.obj", "references/miro/yyang_sponza.ppm.gz"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace sahl::testing
