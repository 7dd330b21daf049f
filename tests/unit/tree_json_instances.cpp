// Nested JSON of scenes whose objects are placed by instances.
#include "unit/tree_json_test.h"

#include <nlohmann/json.hpp>

namespace sahl::testing {
namespace {

PreparedScene placedScene()
{
    return prepareScene(loadScene(instancesScene(), {}), BvhBuild::automatic, 2);
}

class TreeJsonInstancesTest : public TreeJsonTest {
protected:
    /// An instance that moves its object by `number` along x; the box holds a ball of radius 0.5
    /// anywhere near.
    static std::string instance(int number, int object, const std::string& more = "")
    {
        return fmt::format(
            R"({{"type":"instance","number":{},"object":{},{}"toObject":[[1,0,0],[0,1,0],[0,0,1]],)"
            R"("toWorld":[[1,0,0],[0,1,0],[0,0,1]],"translation":[{},0,0],)"
            R"("lo":[-90,-90,-90],"hi":[90,90,90]}})",
            number, object, more, number);
    }

    std::string errorOfTrees(const std::string& objects, const std::string& root)
    {
        return errorOf(file(root, "[]", objects));
    }

    /// `levels` inner nodes in a chain, each with `last` or a sphere on its right, `last` deepest.
    static std::string chain(uint levels, const std::string& last)
    {
        std::string tree = fmt::format("[{}]", last);
        for (uint i = 1; i <= levels; i++)
            tree = fmt::format("[{},[{}]]", tree, sphere(static_cast<int>(i) - 1));
        return tree;
    }
};

TEST_F(TreeJsonInstancesTest, areKeptToTheBit)
{
    const PreparedScene original = placedScene();
    ASSERT_GT(original.bvh.instances.size(), 8u);
    expectSameButNormals(writtenAndRead(original), original);
    const PreparedScene crowd = prepareText(crowdScene());
    expectSameButNormals(writtenAndRead(crowd), crowd);
}

TEST_F(TreeJsonInstancesTest, becomeTheSameTextAgain)
{
    writeTreeJson(placedScene(), path);
    writeTreeJson(loadTreeJson(path, {}), folder.path / "again.json");
    EXPECT_EQ(readFile(path), readFile(folder.path / "again.json"));
}

TEST_F(TreeJsonInstancesTest, becomeABinaryFileAndBack)
{
    const PreparedScene original = placedScene();
    writeSavedScene(writtenAndRead(original), folder.path / "x.sahl");
    const PreparedScene loaded = loadSavedScene(folder.path / "x.sahl", {});
    expectSameButNormals(loaded, original);
    expectSameButNormals(writtenAndRead(loaded), original);
}

TEST_F(TreeJsonInstancesTest, objectsAreWrittenOnceHoweverOftenTheyArePlaced)
{
    const PreparedScene crowd = prepareText(crowdScene());
    writeTreeJson(crowd, path);
    const std::string text = readTextFile(path);
    EXPECT_EQ(nlohmann::json::parse(text)["objects"].size(), 1u);
    auto count = [&](const std::string& word) {
        size_t found = 0;
        for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; at++) found++;
        return found;
    };
    EXPECT_EQ(count("\"triangle\""), crowd.bvh.primitives.size());
    EXPECT_EQ(count("\"instance\""), 20u);
}

TEST_F(TreeJsonInstancesTest, alone_areAWorld)
{
    for (const char* group : {R"({"type": "sphere"})", R"({"type": "sphereMesh", "level": 2})"}) {
        const PreparedScene original = prepareText(fmt::format(
            R"({{"groups": {{"a": {{"shapes": [{}]}}}}, "shapes": [{{"type": "instance", "of": "a"}}],
                 "environment": {{"radiance": [1, 1, 1]}}}})",
            group));
        ASSERT_EQ(original.bvh.rootRef, REF_INSTANCE);
        expectSameButNormals(writtenAndRead(original), original);
    }
}

TEST_F(TreeJsonInstancesTest, writtenByHand_areRead)
{
    const std::string objects =
        fmt::format("[[[{}],[{}]],\n[{}]]", sphere(1), sphere(0), sphere(0));
    const std::string root = fmt::format("[[[{}],[{}]],[{}]]", instance(2, 0), instance(0, 1),
                                         instance(1, 0, "\"material\":0,"));
    writeFileAtomically(path, file(root, "[]", objects));
    const PreparedScene loaded = loadTreeJson(path, {});
    const BvhStatistics& tree = loaded.bvh.statistics;
    EXPECT_EQ(tree.innerNodes, 3u);
    EXPECT_EQ(tree.leaves, 3u);
    EXPECT_EQ(tree.depth, 2u + 1u + 1u);
    EXPECT_EQ(tree.primitivesSeen, 5u);
    const std::span<const ObjectInstance> instances = loaded.deviceScene().instances;
    ASSERT_EQ(instances.size(), 3u);
    EXPECT_EQ(instances[0].firstNumber, 0u);
    EXPECT_EQ(instances[1].firstNumber, 1u);
    EXPECT_EQ(instances[2].firstNumber, 3u);
    EXPECT_EQ(instances[0].rootRef, REF_LEAF | 2u << LEAF_COUNT_BITS);  // behind two spheres
    EXPECT_EQ(instances[1].rootRef, 2u);                                // behind two nodes
    EXPECT_EQ(instances[2].rootRef, 2u);
    EXPECT_EQ(instances[0].material, NO_MATERIAL);
    EXPECT_EQ(instances[1].material, 0u);
}

TEST_F(TreeJsonInstancesTest, thatAreNoneAreRefusedWithTheirPlace)
{
    const std::string ball = fmt::format("[[{}]]", sphere(0));
    auto errorOfInstance = [&](const std::string& one) {
        return errorOfTrees(ball, fmt::format("[{}]", one));
    };
    auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    const std::string good = instance(0, 0);
    ASSERT_EQ(errorOfInstance(good), "");
    EXPECT_CONTAINS(errorOfInstance(instance(0, 1)), "root: instance 0: \"object\" is 1, the file");
    EXPECT_CONTAINS(errorOfRoot(fmt::format("[{}]", good)), "\"object\" is 0, the file has 0");
    EXPECT_CONTAINS(errorOfInstance(instance(1, 0)), "no instance has the number 0");
    EXPECT_CONTAINS(errorOfInstance(instance(1048576, 0)), "there may be 1048576, counted from 0");
    EXPECT_CONTAINS(errorOfInstance(instance(0, 0, "\"material\":1,")), "\"material\" is 1");
    EXPECT_EQ(errorOfInstance(instance(0, 0, "\"material\":0,")), "");
    EXPECT_CONTAINS(errorOfInstance(replaced(good, "\"lo\":[-90", "\"lo\":[91")), "above \"hi\"");
    EXPECT_CONTAINS(errorOfInstance(replaced(good, "\"lo\":[-90,-90,-90],", "")),
                    "lacks the key \"lo\"");
    EXPECT_CONTAINS(errorOfInstance(instance(0, 0, "\"radius\":1,")),
                    "\"instance\" has no key \"radius\"");
    EXPECT_CONTAINS(errorOfInstance(replaced(good, "[[1,0,0]", "[[1,0]")), "a row of \"toObject\"");
    EXPECT_CONTAINS(errorOfInstance(replaced(good, "[[1,0,0],", "[")), "6 numbers where 9");
    EXPECT_CONTAINS(errorOfInstance(replaced(good, "[[1,", "[[1e39,")), "beyond the range");
    EXPECT_CONTAINS(errorOfInstance(replaced(good, "\"object\":0", "\"object\":-1")),
                    "a number is out of place");
    EXPECT_CONTAINS(errorOfInstance(replaced(good, "\"object\":0", "\"object\":4294967296")),
                    "4294967296 is beyond the range of indices");

    EXPECT_CONTAINS(errorOfTrees(ball, fmt::format("[{},{}]", good, sphere(0))),
                    "something beside an instance");
    EXPECT_CONTAINS(errorOfTrees(ball, fmt::format("[{},{}]", sphere(0), good)),
                    "an instance in a group of others");
    EXPECT_CONTAINS(errorOfTrees(ball, fmt::format("[{},{}]", good, instance(1, 0))),
                    "something beside an instance");
    EXPECT_CONTAINS(errorOfTrees(ball, fmt::format("[{},[{}]]", good, sphere(0))),
                    "something beside an instance");
    EXPECT_CONTAINS(errorOfTrees(ball, fmt::format("[[{}],[{}]]", good, good)),
                    "two instances have the number 0");
    EXPECT_CONTAINS(errorOfTrees(ball, good), "an object is out of place");
}

TEST_F(TreeJsonInstancesTest, objectsThatAreNoneAreRefusedWithTheirPlace)
{
    const std::string ball = fmt::format("[{}]", sphere(0)),
                      root = fmt::format("[{}]", instance(0, 0));
    EXPECT_CONTAINS(errorOfTrees(fmt::format("[{},{}]", ball, ball), root),
                    "no instance places objects[1]; leave it out");
    EXPECT_CONTAINS(errorOfTrees(fmt::format("[{},[]]", ball), root),
                    "objects[1]: there is nothing in it");
    EXPECT_CONTAINS(errorOfTrees(fmt::format("[{},[{}]]", ball, instance(0, 0)), root),
                    "objects[1]: instance 0: is in an object, which cannot have any");
    EXPECT_CONTAINS(errorOfTrees(fmt::format("[[{}]]", sphere(1)), root),
                    "number 1 is not below 1");
    EXPECT_CONTAINS(errorOfTrees(sphere(0), root), "an object is out of place");
    EXPECT_CONTAINS(errorOfTrees(fmt::format("[{}]", sphere(0)), root),
                    "an object is out of place");
    EXPECT_CONTAINS(errorOfTrees("7", root), "objects[0]: a number is out of place");
    EXPECT_CONTAINS(errorOfTrees("[7]", root), "objects[0]: a number is out of place");
    EXPECT_CONTAINS(errorOfTrees("null", root), "objects[0]: a word is out of place");
    EXPECT_CONTAINS(errorOfTrees("[]", root), "the file has 0");
    EXPECT_EQ(errorOfTrees("[]", ball), "");
    EXPECT_CONTAINS(errorOfTrees(fmt::format("[{}],\"objects\":[{}]", ball, ball), root),
                    "the key \"objects\" where \"root\" is expected");
    EXPECT_CONTAINS(errorOf(file("[]", "[],\"abjects\":[]")),
                    "the key \"abjects\" where \"objects\" or \"root\" is expected");
    std::string cut = file(root, "[]", fmt::format("[{}]", ball));
    cut.resize(cut.find(",\n\"root\""));
    EXPECT_CONTAINS(errorOf(cut + "}"), "the key \"root\" is missing");
}

TEST_F(TreeJsonInstancesTest, aMillionNestedArraysInAnObjectAreAnErrorAndNoMore)
{
    const std::string deep(1'000'000, '[');
    EXPECT_CONTAINS(errorOfTrees(deep, "[]"), "objects[0]: groups nested deeper than 64 levels");
}

TEST_F(TreeJsonInstancesTest, bothLevelsTogetherMustFitTheStackOfTheTraversal)
{
    // 20 nodes of the world, 1 for the step into the object, and those of the object.
    for (const uint inner : {MAX_STACK_SIZE - 21, MAX_STACK_SIZE - 20}) {
        const std::string object = chain(inner, sphere(static_cast<int>(inner)));
        const std::string error =
            errorOfTrees(fmt::format("[{}]", object), chain(20, instance(0, 0)));
        if (inner == MAX_STACK_SIZE - 21) {
            EXPECT_EQ(error, "");
        } else {
            EXPECT_CONTAINS(error, "the trees of \"root\" (20 nodes deep) and of objects[0] (44)");
        }
    }
}

TEST_F(TreeJsonInstancesTest, areNotSeenFromFartherAwayThanTheirBoxesHoldFor)
{
    writeTreeJson(prepareText(R"({"film": {"width": 30, "height": 30},
        "groups": {"ball": {"shapes": [{"type": "sphere", "radius": 1}]}},
        "shapes": [{"type": "instance", "of": "ball"}], "environment": {"builtin": "studio"}})"),
                  path);
    EXPECT_NO_THROW(loadTreeJson(path, smallPicture(60, 60, 1)));
    try {
        loadTreeJson(path, smallPicture(10, 60, 1));  // narrow: the framing camera moves back
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::usage);
        EXPECT_CONTAINS(error.what(), "a picture of 10 x 60 pixels moves the camera farther away");
    }
}

}  // namespace
}  // namespace sahl::testing
