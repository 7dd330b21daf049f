// Groups and instances of scene files: where they put things, and what is refused.
#include "support/scene_files.h"

#include <cmath>

namespace sahl::testing {
namespace {

/// A scene of the given groups and shapes, with a triangle of corners (0,0,0), (1,0,0), (0,1,0) as
/// "T" and a unit ball as "B".
std::string sceneOf(const std::string& groups, const std::string& shapes,
                    const std::string& rest = "")
{
    const std::string triangle =
        R"({ "type": "triangles", "positions": [[0,0,0],[1,0,0],[0,1,0]], "indices": [[0,1,2]] })";
    std::string text = R"({ "materials": { "red": { "type": "lambert" } }, "groups": { )" + groups +
                       R"( }, "shapes": [ )" + shapes + " ]" + rest + " }";
    for (const auto& [mark, shape] :
         {std::pair<std::string, std::string>{"@T", triangle}, {"@B", R"({ "type": "sphere" })"}}) {
        for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
            text.replace(at, mark.size(), shape);
    }
    return text;
}

const char* const ONE = R"("one": { "shapes": [@T] })";

std::string move(double x, double y, double z)
{
    return fmt::format(R"("transform": {{ "translate": [{}, {}, {}] }})", x, y, z);
}

TEST(Groups, applyTheirTransformAfterThoseOfTheirShapes)
{
    const Scene scene = loadJson(sceneOf(
        "", R"({ "type": "group", "transform": { "rotateDeg": { "axis": [0,0,1], "angle": 90 } },
                 "shapes": [ { "type": "group", )" +
                move(1, 0, 0) + R"(, "shapes": [@T] }, @T ] }, @T)"));
    ASSERT_EQ(scene.primitives.size(), 3u);
    EXPECT_LT(glm::length(scene.primitives[0].p0 - vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(glm::length(scene.primitives[0].p1 - vec3(0, 2, 0)), 1e-6f);
    EXPECT_LT(glm::length(scene.primitives[1].p1 - vec3(0, 1, 0)), 1e-6f);
    EXPECT_EQ(scene.primitives[2].p1, vec3(1, 0, 0));
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_EQ(scene.objectStarts, (std::vector<uint32_t>{0, 1, 2}));
}

TEST(Groups, thatMirrorKeepFrontsInFront)
{
    const Scene scene = loadJson(
        sceneOf("", R"({ "type": "group", "transform": { "scale": [-1,1,1] }, "shapes": [@T] })"));
    const Primitive& t = scene.primitives.at(0);
    EXPECT_GT(glm::cross(t.p1 - t.p0, t.p2 - t.p0).z, 0);
}

TEST(Instances, shareTheirGroup)
{
    const Scene scene = loadJson(
        sceneOf(ONE, R"(@T, { "type": "instance", "of": "one" }, { "type": "instance", "of": "one",
                "material": "red", "transform": { "scale": [2,3,4], "translate": [5,6,7] } })"));
    EXPECT_EQ(scene.primitives.size(), 1u);
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].size(), 1u);
    EXPECT_EQ(scene.objects[0][0].number, 0u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].material, NO_MATERIAL);
    EXPECT_NE(scene.instances[1].material, NO_MATERIAL);
    EXPECT_EQ(scene.instances[1].translation, glm::dvec3(5, 6, 7));
    EXPECT_EQ(scene.instances[1].linear[1], glm::dvec3(0, 3, 0));
    const Box box = extentOf(scene);
    EXPECT_EQ(box.lo, vec3(0, 0, 0));
    EXPECT_EQ(box.hi, vec3(7, 9, 7));
}

TEST(Instances, ofNestedGroupsAreInstancesOfTheWorld)
{
    const std::string groups =
        std::string(ONE) + R"(, "two": { "shapes": [
        { "type": "instance", "of": "one", )" +
        move(1, 0, 0) +
        R"( }, { "type": "instance", "of": "one", "material": "red" }, @B ] },
        "four": { "shapes": [ { "type": "group", )" +
        move(0, 10, 0) + R"(, "shapes": [ { "type": "instance", "of": "two" } ] },
        { "type": "instance", "of": "two" } ] })";
    const Scene scene = loadJson(
        sceneOf(groups, R"({ "type": "instance", "of": "four", "transform": { "scale": 2 } })"));
    EXPECT_EQ(scene.objects.size(), 2u);
    ASSERT_EQ(scene.instances.size(), 6u);
    std::vector<glm::dvec3> at;
    int red = 0;
    for (const Placement& placement : scene.instances) {
        at.push_back(placement.translation);
        red += placement.material != NO_MATERIAL;
        EXPECT_EQ(placement.linear, glm::dmat3(2.0));
    }
    EXPECT_EQ(at[1], glm::dvec3(2, 20, 0));
    EXPECT_EQ(at[4], glm::dvec3(2, 0, 0));
    EXPECT_EQ(red, 2);
}

TEST(Instances, materialOfTheOuterOneCounts)
{
    const std::string groups =
        std::string(ONE) +
        R"(, "two": { "shapes": [ { "type": "instance", "of": "one", "material": "red" } ] })";
    const Scene scene = loadJson(sceneOf(groups, R"({ "type": "instance", "of": "two" },
        { "type": "instance", "of": "two", "material": "red" })"));
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].material, scene.instances[1].material);
}

TEST(Instances, groupsAreReadWhateverTheirOrder)
{
    const std::string groups =
        R"("a": { "shapes": [ { "type": "instance", "of": "z" } ] }, "z": { "shapes": [@T] })";
    EXPECT_EQ(loadJson(sceneOf(groups, R"({ "type": "instance", "of": "a" })")).instances.size(),
              1u);
}

TEST(Instances, cameraFocusesOnTheMiddleOfNamedOnesAndOfGroups)
{
    for (const char* name : {"it", "them"}) {
        const std::string shapes =
            R"({ "type": "instance", "of": "ball", "name": "it", )" + move(0, 0, -3) +
            R"( }, { "type": "group", "name": "them", "shapes": [ { "type": "instance", "of": "ball", )" +
            move(0, 1, -3) + R"( }, { "type": "sphere", "center": [0, -1, -3] } ] })";
        const std::string camera =
            fmt::format(R"(, "camera": {{ "eye": [0,0,5], "lookAt": [0,0,0], "lensRadius": 0.1,
                "focusOn": "{}" }})",
                        name);
        const Scene scene = loadJson(sceneOf(R"("ball": { "shapes": [@B] })", shapes, camera));
        EXPECT_NEAR(scene.camera.focusDistance, 8, 1e-5) << name;
    }
}

TEST(Instances, areFramedWhereThereIsNoCamera)
{
    const Scene scene =
        loadJson(sceneOf(R"("ball": { "shapes": [@B] })",
                         R"({ "type": "instance", "of": "ball", )" + move(100, 0, 0) + " }"));
    const glm::dvec3 way = glm::dvec3(100, 0, 0) - glm::dvec3(scene.camera.position);
    EXPECT_GT(glm::dot(glm::normalize(way), glm::dvec3(scene.camera.forward)), 0.999);
}

TEST(Instances, cyclesAreRefusedWithTheirChain)
{
    const std::string a = R"("a": { "shapes": [ { "type": "instance", "of": "b" } ] }, )";
    const std::string b = R"("b": { "shapes": [ { "type": "instance", "of": "a" } ] })";
    EXPECT_CONTAINS(errorOfJson(sceneOf(a + b, "")), "contains itself: a -> b -> a");
    EXPECT_CONTAINS(
        errorOfJson(sceneOf(R"("a": { "shapes": [ { "type": "instance", "of": "a" } ] })", "")),
        "group \"a\" contains itself: a -> a");
}

TEST(Instances, chainsAreBounded)
{
    std::string groups = R"("g0": { "shapes": [@T] })";
    for (int i = 1; i <= 40; i++) {
        groups =
            fmt::format(R"("g{}": {{ "shapes": [ {{ "type": "instance", "of": "g{}" }} ] }}, )", i,
                        i - 1) +
            groups;
    }
    // The last is read first: its name comes first in the alphabet only for some, so ask for it.
    EXPECT_CONTAINS(errorOfJson(sceneOf(groups + R"(, "a": { "shapes": [
        { "type": "instance", "of": "g40" } ] })",
                                        "")),
                    "nested more than 32 deep");
}

TEST(Instances, tooManyAreRefused)
{
    // Each of 21 groups places the one before twice: 2^21 triangles in the end.
    std::string groups = R"("g00": { "shapes": [@T] })";
    for (int i = 1; i <= 21; i++) {
        const std::string inner = fmt::format(R"({{ "type": "instance", "of": "g{:02}" }})", i - 1);
        groups += fmt::format(R"(, "g{:02}": {{ "shapes": [ {}, {} ] }})", i, inner, inner);
    }
    EXPECT_CONTAINS(errorOfJson(sceneOf(groups, "")), "more than 1048576 instances");
}

TEST(Instances, mistakesAreRefusedWithTheirPlace)
{
    auto error = [](const std::string& shape) { return errorOfJson(sceneOf(ONE, shape)); };
    EXPECT_CONTAINS(error(R"({ "type": "instance", "of": "ome" })"),
                    "group \"ome\" is not defined; did you mean \"one\"?");
    EXPECT_CONTAINS(error(R"({ "type": "instance" })"), "lacks the key \"of\"");
    EXPECT_CONTAINS(error(R"({ "type": "instance", "object": "one" })"), "did you mean \"of\"?");
    EXPECT_CONTAINS(error(R"({ "type": "instance", "of": "one", "material": "rad" })"),
                    "did you mean \"red\"?");
    EXPECT_CONTAINS(error(R"({ "type": "instance", "of": "one",
        "transform": { "scale": [1, 0, 1] } })"),
                    "cannot be inverted");
    EXPECT_CONTAINS(error(R"({ "type": "instance", "of": "one",
        "transform": { "matrix": [1,2,3,0, 2,4,6,0, 0,0,1,0, 0,0,0,1] } })"),
                    "cannot be inverted");
    EXPECT_CONTAINS(
        error(R"({ "type": "instance", "of": "one", "transform": { "scale": 1e-10 } })"),
        "stretched or shrunk by more than 1e+09");
    EXPECT_CONTAINS(error(R"({ "type": "group", "shapes": {} })"), "must be an array");
    EXPECT_CONTAINS(error(R"({ "type": "group", "material": "red", "shapes": [] })"),
                    "unknown key \"material\"");
    EXPECT_CONTAINS(errorOfJson(sceneOf(R"("x": { "shape": [] })", "")),
                    "did you mean \"shapes\"?");
    EXPECT_CONTAINS(errorOfJson(sceneOf(R"("x": {})", "")), "lacks the key \"shapes\"");
    EXPECT_CONTAINS(errorOfJson(sceneOf(R"("": { "shapes": [] })", "")), "a group needs a name");
    EXPECT_CONTAINS(errorOfJson(R"({ "groups": [] })"), "\"groups\" must be an object");
}

TEST(Groups, thatFlattenTogetherAreRefused)
{
    const std::string tiny = R"("transform": { "scale": 1e-200 }, "shapes": [ )";
    const std::string shapes =
        R"({ "type": "group", )" + tiny + R"({ "type": "group", )" + tiny + "@T ] } ] }";
    EXPECT_CONTAINS(errorOfJson(sceneOf("", shapes)), "cannot be inverted");
}

TEST(Groups, thatScaleASphereUnevenlySayWhatToUse)
{
    EXPECT_CONTAINS(errorOfJson(sceneOf("", R"({ "type": "group", "transform": { "scale": [1,2,1] },
        "shapes": [@B] })")),
                    "use an \"instance\" of a group with the sphere");
    EXPECT_EQ(loadJson(sceneOf(R"("b": { "shapes": [@B] })", R"({ "type": "instance", "of": "b",
        "transform": { "scale": [1,2,1] } })"))
                  .instances.size(),
              1u);
}

/// Names inside of shared groups may repeat: they have no one place.
TEST(Groups, namesInsideSharedGroupsAreTheirOwn)
{
    const std::string named = R"({ "shapes": [ { "type": "sphere", "name": "n" } ] })";
    const Scene scene = loadJson(
        sceneOf(R"("a": )" + named + R"(, "b": )" + named, R"({ "type": "sphere", "name": "n" })"));
    EXPECT_EQ(scene.primitives.size(), 1u);
}

}  // namespace
}  // namespace sahl::testing
