// The gate on speed: rays, box tests and primitive tests of a picture may not exceed those of baseline.json
// by more than 0.5 %. Unlike seconds they are the same on every machine. Once they change for a reason,
// tools/cost_baseline writes the new ones.
#include "support/render_scenes.h"
#include "shared/bindings.h"
#include "support/soups.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace sahl::testing {
namespace {

using Json = nlohmann::ordered_json;

constexpr double TOLERANCE = 0.005;
constexpr uint32_t WIDTH = 48, HEIGHT = 32, SPP = 8;

/// Kinds of trees that rays walk through, each with a baseline of its own.
struct Tree {
    const char* name;
    DeviceOptions options;
};
const std::vector<Tree> TREES = {{"binary", {}}};

struct CostScene {
    const char* name;
    PreparedScene (*make)();
};

PreparedScene fromFile(const char* path)
{
    return prepareScene(loadScene(sourceFolder() / path, smallPicture(WIDTH, HEIGHT, SPP)), BvhBuild::automatic, 2);
}

/// In the built-in scene's place, under its lights and its camera.
PreparedScene generated(std::vector<Primitive> primitives, BvhBuild build)
{
    Scene scene = builtInScene(smallPicture(WIDTH, HEIGHT, SPP));
    for (Primitive& primitive : primitives) primitive.number += static_cast<uint>(scene.primitives.size());
    scene.primitives.insert(scene.primitives.end(), primitives.begin(), primitives.end());
    return prepareScene(std::move(scene), build, 2);
}

const std::vector<CostScene> SCENES = {
    {"default", [] { return fromFile("scenes/default/default.json"); }},
    {"built-in", [] { return generated({}, BvhBuild::automatic); }},
    {"instances", [] { return fromFile("tests/scenes/instances.json"); }},
    {"layers", [] { return fromFile("tests/scenes/layers.json"); }},
    {"rough dielectric", [] { return fromFile("tests/scenes/rough_dielectric.json"); }},
    {"phong", [] { return fromFile("tests/scenes/phong.json"); }},
    {"torus", [] { return generated(torus(200, 80), BvhBuild::automatic); }},
    {"torus, binned", [] { return generated(torus(200, 80), BvhBuild::binned); }},
    {"soup", [] { return generated(randomSoup(10'000, 0.05f, 61), BvhBuild::automatic); }},
};

Json costOf(const CostScene& scene, const DeviceOptions& options)
{
    const PreparedScene prepared = scene.make();
    const Counters counted = renderFilm(*makeCpuDevice(options), prepared, 0, SPP).counters;
    return {{"rays", counted.cameraRays + counted.indirectRays + counted.shadowRays},
            {"boxTests", counted.boxTests},
            {"primitiveTests", counted.primitiveTests}};
}

/// What costs more than it may, in words; empty where nothing does.
std::string excess(const Json& cost, const Json& baseline)
{
    std::string words;
    for (const auto& [name, before] : baseline.items()) {
        const double now = cost.at(name).get<double>(), most = before.get<double>() * (1 + TOLERANCE);
        if (now > most)
            words += fmt::format("{}: {} where {} were enough ({:+.2f} %)\n", name, now, before.get<double>(),
                                 100 * (now / before.get<double>() - 1));
    }
    return words;
}

fs::path baselineFile()
{
    return sourceFolder() / "tests/cost/baseline.json";
}

Json baseline()
{
    return Json::parse(readTextFile(baselineFile()));
}

TEST(Cost, ofEveryScene_isNotAboveItsBaseline)
{
    Json measured;
    for (const Tree& tree : TREES) {
        for (const CostScene& scene : SCENES) measured[tree.name][scene.name] = costOf(scene, tree.options);
    }
    if (std::getenv("SAHL_REWRITE_COST") != nullptr) {
        writeFileAtomically(baselineFile(), measured.dump(2) + "\n");
        return;
    }
    const Json before = baseline();
    for (const Tree& tree : TREES) {
        for (const CostScene& scene : SCENES) {
            ASSERT_TRUE(before.at(tree.name).contains(scene.name)) << scene.name << ": run tools/cost_baseline";
            EXPECT_EQ(excess(measured[tree.name][scene.name], before[tree.name][scene.name]), "")
                << scene.name << ", " << tree.name << " tree: see tests/cost/cost.cpp";
        }
    }
}

TEST(Cost, ofAWorseWalk_isFound)
{
    DeviceOptions wrongWay;
    wrongWay.traversalOrder = ORDER_LEFT_FIRST;
    const Json before = baseline().at("binary");
    EXPECT_NE(excess(costOf(SCENES[0], wrongWay), before.at("default")), "");
}

TEST(Cost, isFoundFromHalfAPercentOn)
{
    const Json before = {{"rays", 100'000}, {"boxTests", 100'000}};
    EXPECT_EQ(excess({{"rays", 100'499}, {"boxTests", 90'000}}, before), "");
    EXPECT_EQ(excess({{"rays", 100'501}, {"boxTests", 90'000}}, before), "rays: 100501 where 100000 were enough (+0.50 %)\n");
    EXPECT_NE(excess({{"rays", 1}, {"boxTests", 100'501}}, before), "");
}

}  // namespace
}  // namespace sahl::testing
