// The tree as nested JSON: written, read, and read from other people's hands.
#include "support/soups.h"
#include "unit/tree_json_test.h"

#include <nlohmann/json.hpp>

#include <bit>

namespace sahl::testing {
namespace {

TEST_F(TreeJsonTest, everyArrayAndSettingIsKeptToTheBit)
{
    const PreparedScene original = prepareText(richScene());
    expectSameButNormals(writtenAndRead(original), original);
}

TEST_F(TreeJsonTest, becomesTheSameTextAgain)
{
    writeTreeJson(prepareText(richScene()), path);
    writeTreeJson(loadTreeJson(path, {}), folder.path / "again.json");
    EXPECT_EQ(readFile(path), readFile(folder.path / "again.json"));
}

TEST_F(TreeJsonTest, becomesABinaryFileAndBack)
{
    const PreparedScene original = prepareText(richScene());
    writeSavedScene(writtenAndRead(original), folder.path / "x.sahl");
    expectSameButNormals(loadSavedScene(folder.path / "x.sahl", {}), original);
}

TEST_F(TreeJsonTest, isNestedArraysOfTypedObjects)
{
    writeTreeJson(prepareText(richScene()), path);
    const auto json = nlohmann::json::parse(readTextFile(path));
    EXPECT_EQ(json["sahlTree"], 1);
    const nlohmann::json* group = &json["root"];
    while ((*group)[0].is_array()) {
        EXPECT_EQ(group->size(), 2u);
        group = &(*group)[0];
    }
    for (const auto& leaf : *group) {
        EXPECT_TRUE(leaf["type"] == "triangle" || leaf["type"] == "sphere") << leaf;
    }
}

TEST_F(TreeJsonTest, nothingAndASingleLeafAreTrees)
{
    for (const char* text : {R"({"environment": {"radiance": [1, 2, 3]}})",
                             R"({"shapes": [{"type": "sphere", "radius": 1}]})"}) {
        const PreparedScene original = prepareText(text);
        expectSameButNormals(writtenAndRead(original), original);
    }
}

TEST_F(TreeJsonTest, everyFloatComesBackAsItWas)
{
    // Random bits, and what is known to be hard: halfway cases, powers of two, denormals, zeros.
    std::vector<float> floats = {0.0f,           -0.0f, 0x1p-149f,   0x1.fffffcp-127f,    0x1p-126f,
                                 0.1f,           0.3f,  16777216.0f, 9.5367431640625e-7f, 1e10f,
                                 0x1.fffffep+59f};
    Random random(1);
    while (floats.size() < 9 * 3000) {
        const float x = std::bit_cast<float>(static_cast<uint32_t>(random.bits()));
        if (std::abs(x) < 1e18f) floats.push_back(x);
    }
    std::vector<Primitive> triangles;
    for (size_t i = 0; i + 9 <= floats.size(); i += 9) {
        const float* f = &floats[i];
        addTriangle(triangles, {f[0], f[1], f[2]}, {f[3], f[4], f[5]}, {f[6], f[7], f[8]});
    }
    Scene scene = loadJson(R"({"shapes": [{"type": "sphere", "radius": 1}]})");
    scene.primitives = triangles;
    const PreparedScene original = prepareScene(std::move(scene), BvhBuild::sweep, 2);
    expectSameButNormals(writtenAndRead(original), original);
}

TEST_F(TreeJsonTest, writtenByHand_isRead)
{
    writeFileAtomically(
        path, file("[[" + sphere(0) + "],\n [[" + sphere(2) + "], [" + sphere(1) + "]]]"));
    const PreparedScene loaded = loadTreeJson(path, {});
    EXPECT_EQ(loaded.bvh.statistics.innerNodes, 2u);
    EXPECT_EQ(loaded.bvh.statistics.leaves, 3u);
    EXPECT_EQ(loaded.bvh.statistics.depth, 2u);
    EXPECT_EQ(loaded.deviceScene().primitives[1].number, 2u);
}

TEST_F(TreeJsonTest, whatIsNoTreeIsRefusedWithItsPlace)
{
    const std::string a = sphere(0), b = sphere(1), c = sphere(2);
    EXPECT_CONTAINS(errorOfRoot("[[" + a + "]]"), "a group of a single group; there must be two");
    EXPECT_CONTAINS(errorOfRoot("[[" + a + "],[" + b + "],[" + c + "]]"), "a third group");
    EXPECT_CONTAINS(errorOfRoot("[[" + a + "]," + b + "]"), "a leaf in a group of groups");
    EXPECT_CONTAINS(errorOfRoot("[" + a + ",[" + b + "]]"), "a group in a group of leaves");
    EXPECT_CONTAINS(errorOfRoot("[[" + a + "],[]]"), "a group of nothing");
    EXPECT_CONTAINS(errorOfRoot(a), "an object is out of place");
    EXPECT_CONTAINS(errorOfRoot("5"), "a number is out of place");
    EXPECT_CONTAINS(errorOfRoot("[5]"), "a number is out of place");
    EXPECT_CONTAINS(errorOfRoot("[null]"), "a word is out of place");
    EXPECT_CONTAINS(errorOfRoot("[\"x\"]"), "a text is out of place");
    std::string nine = fmt::format("[{}", a);
    for (int i = 1; i < 9; i++) nine += fmt::format(",{}", sphere(i));
    EXPECT_CONTAINS(errorOfRoot(nine + "]"), "a group of more than 8 leaves");
    const std::string text = file("[\n[" + a + "],[7]]");
    const auto line = 1 + std::count(text.begin(), text.end(), '\n');
    EXPECT_CONTAINS(errorOf(text), fmt::format("tree.json:{}:", line));
}

TEST_F(TreeJsonTest, leavesThatAreIncompleteOrOddAreRefused)
{
    auto errorOfLeaf = [&](const std::string& leaf) { return errorOfRoot("[" + leaf + "]"); };
    auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    const std::string ball = sphere(0);
    EXPECT_CONTAINS(errorOfLeaf("{}"), "a leaf lacks the key \"type\"");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, ",\"radius\":0.5", "")), "lacks the key \"radius\"");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "radius", "radios")), "unknown key \"radios\"");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "0.5", "0.5,\"radius\":1")), "duplicate key");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "\"sphere\"", "\"cube\"")), "\"cube\"");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "0.5", "0.5,\"p2\":[0,0,0]")), "has no key \"p2\"");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "0.5", "-1")), "radius");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "0.5", "1e39")), "beyond the range");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "0.5", "1e400")), "tree.json:");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "0.5", "[0.5]")), "an array is out of place");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "[0,0,0]", "[0,0]")), "2 numbers where 3");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "[0,0,0]", "[0,0,[0]]")), "an array is out of");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "[0,0,0]", "[0,0,0,0,0,0,0,0,0,0]")), "too many");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "\"material\":0", "\"material\":1")), "material 1");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "\"number\":0", "\"number\":1")), "number 1");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "\"number\":0", "\"number\":0.5")), "out of place");
    EXPECT_CONTAINS(errorOfLeaf(replaced(ball, "\"number\":0", "\"number\":4294967296")),
                    "indices");
    EXPECT_CONTAINS(errorOfRoot("[" + ball + "," + ball + "]"), "number 0");
    const std::string flat =
        R"([{"type":"triangle","number":0,"material":0,"p0":[0,0,0],"p1":[1,0,0],"p2":[0,1,0],)";
    EXPECT_CONTAINS(errorOfRoot(flat + R"("normals":[[0,0,1],[0,0,1]]}])"), "6 numbers where 9");
    EXPECT_CONTAINS(errorOfRoot(flat + R"("normals":[[0,0,1,0],[0,1],[0,0,1]]}])"), "3 numbers");
    EXPECT_CONTAINS(errorOfRoot(flat + R"("normals":[[0,0,1],[0,0,2],[0,0,1]]}])"), "unit");
    EXPECT_EQ(errorOfRoot(flat + R"("normals":[[0,0,1],[0,0,1],[0,0,1]]}])"), "");
}

TEST_F(TreeJsonTest, theFileAsAWholeIsChecked)
{
    const std::string good = file(fmt::format("[{}]", sphere(0)));
    ASSERT_EQ(errorOf(good), "");
    auto replaced = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_CONTAINS(errorOf(""), "tree.json:1:1");
    EXPECT_CONTAINS(errorOf("[]"), "an array is out of place");
    EXPECT_CONTAINS(errorOf("{\"sahlTree\":1}"), "the key \"scene\" is missing");
    EXPECT_CONTAINS(errorOf("{\"sahlTree\":1,\"scene\":5}"), "must be an object");
    EXPECT_CONTAINS(errorOf("{\"sahlTree\":1,\"scene\":[{}]}"), "must be an object");
    EXPECT_CONTAINS(errorOf(replaced("\"sahlTree\":1", "\"sahlTree\":2")), "version 2");
    EXPECT_CONTAINS(errorOf(replaced("\"texels\"", "\"lexels\"")), "\"texels\" is expected");
    EXPECT_CONTAINS(errorOf(replaced("\"jitter\"", "\"jutter\"")), "unknown key \"jutter\"");
    EXPECT_CONTAINS(errorOf(good + "1"), "tree.json:");
    EXPECT_CONTAINS(errorOf(good.substr(0, good.size() - 1)), "tree.json:");
    EXPECT_CONTAINS(errorOf(good.substr(0, good.size() - 1) + ",\"more\":1}"), "no key may follow");
    EXPECT_CONTAINS(errorOf(file("[]", "[1]")), "a number is out of place");
    EXPECT_CONTAINS(errorOf(file("[]", "[[1,2]]")), "2 numbers where 3");
    EXPECT_CONTAINS(errorOf(file("[]", "[[1,2,-3]]")), "texels");
}

TEST_F(TreeJsonTest, aMillionNestedArraysAreAnErrorAndNoMore)
{
    const std::string deep(1'000'000, '[');
    EXPECT_CONTAINS(errorOfRoot(deep), "groups nested deeper than 64 levels");
    EXPECT_CONTAINS(errorOfRoot(deep + std::string(deep.size(), ']')), "nested deeper than 64");
    EXPECT_CONTAINS(errorOf("{\"sahlTree\":1,\"scene\":{\"camera\":" + deep),
                    "nested deeper than 64");
    EXPECT_CONTAINS(errorOf(file("[]", deep)), "an array is out of place");
    EXPECT_CONTAINS(errorOf(deep), "an array is out of place");
}

TEST_F(TreeJsonTest, theDeepestTreeThatCanBeRenderedIsRead)
{
    // A chain of MAX_STACK_SIZE inner nodes works, one more does not.
    for (const int nodes : {int{MAX_STACK_SIZE}, int{MAX_STACK_SIZE} + 1}) {
        std::string root = fmt::format("[{}]", sphere(0));
        for (int i = 1; i <= nodes; i++) root = fmt::format("[{},[{}]]", root, sphere(i));
        const std::string error = errorOfRoot(root);
        if (nodes == int{MAX_STACK_SIZE}) {
            EXPECT_EQ(error, "");
        } else {
            EXPECT_CONTAINS(error, "nested deeper than 64 levels");
        }
    }
}

}  // namespace
}  // namespace sahl::testing
