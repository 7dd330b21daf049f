// Saved scenes that are cut short, altered, foreign or hostile: each is refused by name, and
// whatever is not refused renders.
#include "faults/saved_faults.h"

namespace sahl::testing {
namespace {

TEST_F(SavedFaults, aThousandTruncationsAndFlippedBitsAreRefused)
{
    Random random(2026);
    for (int i = 0; i < 1000; i++) {
        std::vector<uint8_t> bytes = whole;
        const size_t at = random.bits() % whole.size();
        if (i % 2 == 0) {
            bytes.resize(at);
        } else {
            bytes[at] = static_cast<uint8_t>(bytes[at] ^ (1u << random.below(8)));
        }
        const std::string error = errorOfBytes(bytes);
        ASSERT_TRUE(error.starts_with("x.sahl: ")) << i << " at " << at << ": " << error;
    }
    EXPECT_EQ(errorOfBytes(whole), "");
}

TEST_F(SavedFaults, everyByteOfTheHeadCounts)
{
    const size_t head = sizeof(SavedHeader) + 11 * sizeof(SavedEntry);
    for (size_t at = 0; at < head; at++) {
        std::vector<uint8_t> bytes = whole;
        bytes[at] ^= 1;
        EXPECT_NE(errorOfBytes(bytes), "") << at;
    }
}

TEST_F(SavedFaults, bytesInFrontOfSectionsAndBehindTheLastAreRefused)
{
    std::vector<uint8_t> longer = whole;
    longer.push_back(0);
    EXPECT_CONTAINS(errorOfBytes(longer), "it was cut short or something was added");
    SavedHeader header;
    std::memcpy(&header, whole.data(), sizeof(header));
    std::vector<SavedEntry> entries(header.sectionCount);
    std::memcpy(entries.data(), whole.data() + sizeof(header), entries.size() * sizeof(SavedEntry));
    const auto gap = std::adjacent_find(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        return a.offset + a.bytes < b.offset;
    });
    ASSERT_NE(gap, entries.end());
    const SavedEntry& second = *(gap + 1);
    std::vector<uint8_t> filled = whole;
    filled[second.offset - 1] = 1;
    EXPECT_CONTAINS(errorOfBytes(filled), fmt::format("section '{}': the byte at", second.name.data()));
}

TEST_F(SavedFaults, foreignFilesAreToldFromDamagedOnes)
{
    EXPECT_CONTAINS(errorOfBytes({}), "x.sahl: is empty");
    EXPECT_CONTAINS(errorOfBytes({'v', ' ', '0'}), "is not a saved scene of Sahl");
    EXPECT_CONTAINS(errorOfBytes({whole.begin(), whole.begin() + 20}), "cut short");
    // A transfer as text turns \r\n into \n.
    std::vector<uint8_t> text = whole;
    text.erase(text.begin() + 5);
    EXPECT_CONTAINS(errorOfBytes(text), "is not a saved scene of Sahl");
}

TEST_F(SavedFaults, anotherVersionMachineOrLayoutIsNamed)
{
    EXPECT_CONTAINS(errorOfHeader([](auto& header, auto&) { header.version = 3; }),
                    "section 'header': the format's version is 3, this program reads version 2");
    EXPECT_CONTAINS(errorOfHeader([](auto& header, auto&) { header.version = 0; }), "version is 0");
    EXPECT_CONTAINS(errorOfHeader([](auto& header, auto&) { header.byteOrder = 0x04030201; }),
                    "another byte order");
    EXPECT_CONTAINS(errorOfHeader([](auto& header, auto&) { header.entryBytes = 72; }),
                    "entries of 72 bytes");
    EXPECT_CONTAINS(errorOfHeader([](auto& header, auto&) { header.sectionCount = 0xffffffff; }),
                    "sections do not fit");
    EXPECT_CONTAINS(errorOfHeader([](auto& header, auto&) { header.fileBytes--; }), "bytes");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        sectionNamed(sections, "materials").elementBytes = 32;
                    }),
                    fmt::format("section 'materials': its elements have 32 bytes, {} are expected",
                                sizeof(Material)));
}

TEST_F(SavedFaults, sectionsThatOverlapOrRunPastTheEndAreRefused)
{
    EXPECT_CONTAINS(errorOfHeader([](auto&, auto& table) { table[2].offset = table[1].offset; }),
                    "section 'primitives': it begins at byte");
    EXPECT_CONTAINS(errorOfHeader([](auto&, auto& table) { table[1].offset += 64; }),
                    "sections overlap or leave a gap");
    EXPECT_CONTAINS(errorOfHeader([](auto&, auto& table) { table.back().bytes += 64; }),
                    "beyond the end of the file");
    EXPECT_CONTAINS(errorOfHeader([](auto&, auto& table) { table[1].bytes = ~uint64_t{0} - 63; }),
                    "beyond the end of the file");
    EXPECT_CONTAINS(errorOfHeader([](auto&, auto& table) { table[1].elementBytes = 0; }),
                    "no whole number of elements");
    EXPECT_CONTAINS(errorOfHeader([](auto&, auto& table) { table[1].name.fill('x'); }),
                    "a section's name has no end");
}

TEST_F(SavedFaults, missingUnknownAndDoubleSectionsAreRefused)
{
    EXPECT_CONTAINS(errorOfSections([](auto& sections) { sections.erase(sections.begin() + 1); }),
                    "section 'nodes': it is missing");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        sections.push_back({"hair", {}, 4});
                    }),
                    "section 'hair': this program does not know it");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) { sections.push_back(sections.back()); }),
                    "there are two of this name");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) { sections.clear(); }), "it is missing");
}

TEST_F(SavedFaults, treesThatAreNoneAreRefused)
{
    auto errorOfNode = [&](size_t index, std::function<void(BvhNode&)> alter) {
        return errorOfElement<BvhNode>("nodes", index, alter);
    };
    // Back to the root: a circle. To itself. To a node that another owns. Beyond the end. To
    // nothing.
    EXPECT_CONTAINS(errorOfNode(3, [](BvhNode& n) { n.ref0 = 0; }), "it refers to node 0");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.ref0 = 0; }), "it refers to node 0");
    EXPECT_CONTAINS(errorOfNode(1, [](BvhNode& n) { n.ref1 = 2; }), "it refers to node 2;");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.ref0 = 0x3fffffff; }), "node 1073741823");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.ref0 = REF_LEAVE; }), "instance 1073741823");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.ref0 = REF_INSTANCE; }),
                    "instance 0; there are 0");
    EXPECT_CONTAINS(errorOfNode(2, [](BvhNode& n) { n.ref1 = REF_NONE; }), "there is nothing");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.ref0 = REF_LEAF; }), "a leaf of ");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.ref0 = 0xfffffff0; }),
                    "a leaf of 1 primitives");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.hi0.x += 1; }), "its box is not that");
    EXPECT_CONTAINS(errorOfNode(0, [](BvhNode& n) { n.lo1.y = std::nanf(""); }), "its box is not");
    EXPECT_CONTAINS(errorOfDescription("\"rootRef\":0", "\"rootRef\":1"), "the root: it refers");
    EXPECT_CONTAINS(errorOfDescription("\"rootRef\":0", "\"rootRef\":4294967295"),
                    "without a tree");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        OwnSection& nodes = sectionNamed(sections, "nodes");
                        nodes.bytes.resize(nodes.bytes.size() + sizeof(BvhNode));
                    }),
                    "the tree has");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        OwnSection& primitives = sectionNamed(sections, "primitives");
                        primitives.bytes.resize(primitives.bytes.size() - sizeof(Primitive));
                    }),
                    "they should begin at");
}

TEST_F(SavedFaults, aTreeDeeperThanTheStackIsRefused)
{
    // A chain of spheres, one more inner node than a traversal can hold.
    const uint count = MAX_STACK_SIZE + 2;
    EXPECT_CONTAINS(errorOfSections([&](std::vector<OwnSection>& sections) {
                        OwnSection& nodes = sectionNamed(sections, "nodes");
                        OwnSection& primitives = sectionNamed(sections, "primitives");
                        nodes.bytes.assign((count - 1) * sizeof(BvhNode), {});
                        primitives.bytes.assign(count * sizeof(Primitive), {});
                        for (uint i = 0; i < count; i++) {
                            primitives.set<Primitive>(
                                i, {{float(i), 0, 0}, i, {1, 0, 0}, 0, {0, 0, 0}, SHAPE_SPHERE});
                            if (i + 1 == count) break;
                            BvhNode node = {};
                            node.ref0 = i + 2 < count ? i + 1 : REF_LEAF;
                            node.ref1 = REF_LEAF;
                            nodes.set(i, node);
                        }
                    }),
                    "the tree is deeper than 64 nodes");
}

TEST_F(SavedFaults, indicesOutOfRangeAreRefused)
{
    auto errorOfPrimitive = [&](std::function<void(Primitive&)> alter) {
        return errorOfElement<Primitive>("primitives", 5, alter);
    };
    EXPECT_CONTAINS(errorOfPrimitive([](Primitive& p) { p.material = 1000; }),
                    "section 'primitives': primitive 5: material 1000 of 5");
    EXPECT_CONTAINS(errorOfPrimitive([](Primitive& p) { p.shape = 0xfffffff0; }),
                    "primitive 5: normals 4294967280 of");
    EXPECT_CONTAINS(errorOfPrimitive([](Primitive& p) { p.number = 0xffffffff; }),
                    "primitive 5: its number 4294967295 is not below");
    EXPECT_CONTAINS(errorOfPrimitive([](Primitive& p) { p.number ^= 1; }), "another one's, too");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        OwnSection& starts = sectionNamed(sections, "objectStarts");
                        starts.set<uint32_t>(1, 0xfffffff0);
                    }),
                    "section 'objectStarts'");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        OwnSection& materials = sectionNamed(sections, "materials");
                        materials.bytes.resize(materials.bytes.size() - sizeof(Material));
                    }),
                    "5 names of 4 materials");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        OwnSection& texels = sectionNamed(sections, "texels");
                        texels.bytes.resize(texels.bytes.size() - sizeof(vec4));
                    }),
                    "a probe of 1 x 1 texels from");
    EXPECT_CONTAINS(errorOfDescription("\"width\":256,\"height\":128",
                                       "\"width\":4294967295,\"height\":4294967295"),
                    "a probe of 4294967295 x 4294967295");
}

TEST_F(SavedFaults, numbersThatAreNoneAreRefused)
{
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    EXPECT_CONTAINS(errorOfElement<Primitive>("primitives", 7, [&](Primitive& p) { p.p1.y = nan; }),
                    "primitive 7: a coordinate is not finite");
    EXPECT_CONTAINS(
        errorOfElement<Primitive>("primitives", 7, [&](Primitive& p) { p.p2.z = infinity; }),
        "primitive 7: a coordinate is not finite");
    EXPECT_CONTAINS(errorOfElement<Primitive>("primitives", 7,
                                              [&](Primitive& p) {
                                                  p.shape = SHAPE_SPHERE;
                                                  p.p1.x = -1;
                                              }),
                    "a sphere whose radius is not positive");
    EXPECT_CONTAINS(
        errorOfElement<TriangleCorners>("corners", 3, [&](TriangleCorners& n) { n.n1.x = nan; }),
        "section 'corners': those of number 3");
    EXPECT_CONTAINS(errorOfElement<Material>("materials", 1, [&](Material& m) { m.eta = 0; }),
                    "section 'materials': number 1");
    EXPECT_CONTAINS(errorOfElement<Material>("materials", 1, [&](Material& m) { m.type = 77; }),
                    "section 'materials': number 1");
    EXPECT_CONTAINS(errorOfElement<Light>("lights", 0, [&](Light& l) { l.intensity.x = infinity; }),
                    "section 'lights': number 0");
    EXPECT_CONTAINS(errorOfElement<vec4>("texels", 9, [&](vec4& t) { t.y = nan; }),
                    "section 'texels': number 9");
    EXPECT_CONTAINS(errorOfDescription("\"axisX\":[", "\"axisX\":[1e30,0,0],\"unused\":["),
                    "unused");
}

TEST_F(SavedFaults, descriptionsThatDoNotFitAreRefused)
{
    EXPECT_CONTAINS(errorOfDescription("\"maxBounces\":5", "\"maxBounces\":-5"), "maxBounces");
    EXPECT_CONTAINS(errorOfDescription("\"width\":24", "\"width\":99999"), "\"width\"");
    EXPECT_CONTAINS(errorOfDescription("\"path\"", "\"bath\""), "did you mean \"path\"?");
    EXPECT_CONTAINS(errorOfDescription("\"camera\"", "\"kamera\""), "unknown key \"kamera\"");
    EXPECT_CONTAINS(errorOfDescription("\"fovDeg\":33.3", "\"fovDeg\":180"), "fovDeg");
    EXPECT_CONTAINS(errorOfDescription("\"materialNames\"", "\"materialnames\""), "materialNames");
    EXPECT_CONTAINS(errorOfDescription("{", "{\"a\":" + std::string(1'000'000, '[')), "deeper");
    EXPECT_CONTAINS(errorOfSections([](auto& sections) {
                        sectionNamed(sections, "scene").setText(std::string(17'000'000, ' '));
                    }),
                    "section 'scene': it has 17000000 bytes");
}

TEST_F(SavedFaults, hostileContentsUnderRightHashesAreRefusedOrRender)
{
    const int rendered = renderHostileVariants(path, 984, 600);
    EXPECT_GT(rendered, 20);  // else nothing was shown about what passes
    EXPECT_LT(rendered, 400);
}

}  // namespace
}  // namespace sahl::testing
