// Saved scenes that are cut short, altered, foreign or hostile: each is refused by name, and
// whatever is not refused renders.
#include "support/saved_files.h"
#include "support/soups.h"

#include <functional>

namespace sahl::testing {
namespace {

class SavedFaults : public ::testing::Test {
protected:
    SavedFaults()
    {
        writeSavedScene(prepareText(richScene()), path);
        whole = readFile(path);
    }

    /// What loading these bytes says, without the folder.
    std::string errorOfBytes(const std::vector<uint8_t>& bytes)
    {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return errorOfFile();
    }

    std::string errorOfFile()
    {
        std::string error = badInputOf([&] { loadSavedScene(path, {}); });
        const std::string place = folder.path.string() + "/";
        for (size_t at; (at = error.find(place)) != std::string::npos;)
            error.erase(at, place.size());
        return error;
    }

    /// What is said of a file whose hashes are right and whose sections are as `alter` leaves them.
    std::string errorOfSections(const std::function<void(std::vector<OwnSection>&)>& alter)
    {
        writeFileAtomically(path, whole);
        std::vector<OwnSection> sections = sectionsOf(path);
        alter(sections);
        writeSections(path, sections);
        return errorOfFile();
    }

    /// The same for one element of one section.
    template <class Element>
    std::string errorOfElement(const std::string& section, size_t index,
                               const std::function<void(Element&)>& alter)
    {
        return errorOfSections([&](std::vector<OwnSection>& sections) {
            OwnSection& own = sectionNamed(sections, section);
            Element element = own.get<Element>(index);
            alter(element);
            own.set(index, element);
        });
    }

    std::string errorOfDescription(const std::string& from, const std::string& to)
    {
        return errorOfSections([&](std::vector<OwnSection>& sections) {
            OwnSection& own = sectionNamed(sections, "scene");
            std::string text = own.text();
            ASSERT_NE(text.find(from), std::string::npos) << text;
            own.setText(text.replace(text.find(from), from.size(), to));
        });
    }

    /// Error for a header with one field altered and its hash made right again.
    std::string errorOfHeader(
        const std::function<void(SavedHeader&, std::vector<SavedEntry>&)>& alter)
    {
        std::vector<uint8_t> bytes = whole;
        SavedHeader header;
        std::memcpy(&header, bytes.data(), sizeof(header));
        std::vector<SavedEntry> table(header.sectionCount);
        const size_t tableBytes = table.size() * sizeof(SavedEntry);
        std::memcpy(table.data(), bytes.data() + sizeof(header), tableBytes);
        alter(header, table);
        header.hash = 0;
        std::memcpy(bytes.data(), &header, sizeof(header));
        std::memcpy(bytes.data() + sizeof(header), table.data(), tableBytes);
        header.hash = hashOf(std::as_bytes(std::span(bytes)).first(sizeof(header) + tableBytes));
        std::memcpy(bytes.data(), &header, sizeof(header));
        return errorOfBytes(bytes);
    }

    TemporaryFolder folder;
    fs::path path = folder.path / "x.sahl";
    std::vector<uint8_t> whole;
};

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
    const size_t head = sizeof(SavedHeader) + 9 * sizeof(SavedEntry);
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
    SavedEntry first, second;
    std::memcpy(&header, whole.data(), sizeof(header));
    std::memcpy(&first, whole.data() + sizeof(header), sizeof(first));
    std::memcpy(&second, whole.data() + sizeof(header) + sizeof(first), sizeof(second));
    ASSERT_LT(first.offset + first.bytes, second.offset);
    std::vector<uint8_t> filled = whole;
    filled[second.offset - 1] = 1;
    EXPECT_CONTAINS(errorOfBytes(filled), "section 'nodes': the byte at");
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
    EXPECT_CONTAINS(errorOfHeader([](auto& header, auto&) { header.version = 2; }),
                    "section 'header': the format's version is 2, this program reads version 1");
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
                    "section 'primitives'");
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

/// The same with instances: objects of one leaf and of a tree, the first placed twice.
class SavedInstanceFaults : public SavedFaults {
protected:
    SavedInstanceFaults()
    {
        writeSavedScene(prepareText(R"({
            "camera": {"eye": [0, 2, 6], "lookAt": [0, 0, 0]},
            "groups": {"a": {"shapes": [{"type": "sphere"}]},
                       "b": {"shapes": [{"type": "teapot", "subdivisions": 2}]}},
            "shapes": [{"type": "sphere", "radius": 0.5},
                       {"type": "instance", "of": "a", "transform": {"translate": [3, 0, 0]}},
                       {"type": "instance", "of": "b"},
                       {"type": "instance", "of": "a", "transform": {"scale": [1, 2, -1]}}],
            "environment": {"builtin": "studio"}})"),
                        path);
        whole = readFile(path);
    }

    std::string errorOfInstance(const std::function<void(ObjectInstance&)>& alter)
    {
        return errorOfElement<ObjectInstance>("instances", 1, alter);
    }
};

TEST_F(SavedInstanceFaults, instancesThatAreNoneAreRefused)
{
    EXPECT_EQ(errorOfBytes(whole), "");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.rootRef = 0; }), "instances");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.rootRef = REF_NONE; }), "instances");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.rootRef++; }), "instances");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.firstNumber++; }),
                    "number 1 counts its primitives from");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.material = 77; }),
                    "number 1 has a material or a number out of range");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.toObject1.y = INFINITY; }),
                    "number 1 has a material or a number out of range");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.lo.x -= 1; }), "its box is not that");
    EXPECT_CONTAINS(errorOfInstance([](ObjectInstance& o) { o.hi.x = NAN; }), "out of range");
    auto errorOfNode = [&](uint ref) {
        return errorOfElement<BvhNode>("nodes", 0, [ref](BvhNode& n) {
            ((n.ref0 & REF_NOT_INNER) == REF_INSTANCE ? n.ref0 : n.ref1) = ref;
        });
    };
    EXPECT_NE(errorOfNode(REF_INSTANCE | 3), "");
    EXPECT_NE(errorOfNode(REF_LEAF), "");
    EXPECT_NE(errorOfNode(REF_LEAVE), "");
    // An instance inside of an object, where only the world has them.
    EXPECT_CONTAINS(errorOfSections([](std::vector<OwnSection>& sections) {
                        OwnSection& nodes = sectionNamed(sections, "nodes");
                        const size_t last = nodes.bytes.size() / sizeof(BvhNode) - 1;
                        BvhNode node = nodes.get<BvhNode>(last);
                        node.ref1 = REF_INSTANCE;
                        nodes.set(last, node);
                    }),
                    "an instance inside the object of another");
    // One instance that the tree does not have.
    EXPECT_CONTAINS(errorOfSections([](std::vector<OwnSection>& sections) {
                        OwnSection& instances = sectionNamed(sections, "instances");
                        const ObjectInstance first = instances.get<ObjectInstance>(0);
                        instances.bytes.resize(instances.bytes.size() + sizeof(ObjectInstance));
                        instances.set(3, first);
                    }),
                    "the tree has 3 of 4");
}

TEST_F(SavedInstanceFaults, aThousandTruncationsAndFlippedBitsAreRefused)
{
    Random random(2027);
    for (int i = 0; i < 1000; i++) {
        std::vector<uint8_t> bytes = whole;
        const size_t at = random.bits() % whole.size();
        if (i % 2 == 0) {
            bytes.resize(at);
        } else {
            bytes[at] = static_cast<uint8_t>(bytes[at] ^ (1u << random.below(8)));
        }
        ASSERT_NE(errorOfBytes(bytes), "") << i << " at " << at;
    }
}

TEST_F(SavedInstanceFaults, jsonHoldsOneTreeAndSaysSo)
{
    const PreparedScene scene = loadSavedScene(path, {});
    EXPECT_CONTAINS(badInputOf([&] { writeTreeJson(scene, folder.path / "x.json"); }),
                    "it has 3 instances, and JSON holds one tree; save it as .sahl");
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

/// The same with a scene of instances.
class SavedInstanceFaults : public SavedFaults {
protected:
    SavedInstanceFaults()
    {
        scene = prepareScene(loadScene(instancesScene(), {}), BvhBuild::sweep, 2);
        writeSavedScene(scene, path);
        whole = readFile(path);
    }

    std::string errorOfInstance(size_t index, const std::function<void(ObjectInstance&)>& alter)
    {
        return errorOfElement<ObjectInstance>("instances", index, alter);
    }

    PreparedScene scene;
};

TEST_F(SavedInstanceFaults, instancesThatPointAnywhereElseAreRefused)
{
    ASSERT_EQ(errorOfBytes(whole), "");
    for (const uint root : {0u, 1u, 0x3fffffffu, REF_INSTANCE, REF_LEAVE, REF_LEAF, REF_NONE}) {
        EXPECT_CONTAINS(errorOfInstance(1, [&](ObjectInstance& o) { o.rootRef = root; }),
                        "x.sahl: ")
            << root;
    }
    EXPECT_CONTAINS(errorOfInstance(1, [](ObjectInstance& o) { o.material = 99; }),
                    "section 'instances': number 1 has a material");
    EXPECT_CONTAINS(errorOfInstance(0, [](ObjectInstance& o) { o.firstNumber++; }),
                    "number 0 counts its primitives from");
    EXPECT_CONTAINS(errorOfInstance(2, [](ObjectInstance& o) { o.toObject1.y = std::nanf(""); }),
                    "section 'instances': number 2");
    EXPECT_CONTAINS(errorOfInstance(2, [](ObjectInstance& o) { std::swap(o.lo, o.hi); }),
                    "section 'instances': number 2");
    EXPECT_CONTAINS(errorOfInstance(2, [](ObjectInstance& o) { o.hi.x += 1; }), "its box is not");
}

TEST_F(SavedInstanceFaults, instancesInsideInstancesAreRefused)
{
    // A walk knows one way back only.
    const DeviceScene arrays = scene.deviceScene();
    const auto placed =
        std::find_if(arrays.instances.begin(), arrays.instances.end(),
                     [](const ObjectInstance& o) { return o.rootRef < REF_INSTANCE; });
    ASSERT_NE(placed, arrays.instances.end());
    EXPECT_CONTAINS(errorOfElement<BvhNode>("nodes", placed->rootRef,
                                            [](BvhNode& n) { n.ref0 = REF_INSTANCE; }),
                    "an instance inside the object of another");
    EXPECT_CONTAINS(errorOfElement<BvhNode>("nodes", 0, [](BvhNode& n) { n.ref0 = REF_INSTANCE; }),
                    "x.sahl: ");
    EXPECT_CONTAINS(errorOfElement<BvhNode>("nodes", 0, [](BvhNode& n) { n.ref0 = REF_LEAVE; }),
                    "instance 1073741823; there are");
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
        errorOfElement<TriangleNormals>("normals", 3, [&](TriangleNormals& n) { n.n1.x = nan; }),
        "section 'normals': those of number 3");
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

/// Loads files with a few words of one section replaced, hashes right; renders what is not refused.
/// Returns how many were rendered.
int renderHostileVariants(const fs::path& path, uint64_t seed, int count)
{
    Random random(seed);
    const std::vector<OwnSection> good = sectionsOf(path);
    const std::unique_ptr<Device> device = makeCpuDevice({});
    int rendered = 0;
    for (int i = 0; i < count; i++) {
        std::vector<OwnSection> sections = good;
        OwnSection* section = nullptr;
        while (section == nullptr || section->name == "scene" || section->bytes.empty()) {
            section = &sections[random.below(static_cast<uint>(sections.size()))];
        }
        const uint words = static_cast<uint>(section->bytes.size() / 4);
        for (uint k = random.below(2) + 1; k > 0; k--) {
            const uint32_t hard[] = {0,          1,
                                     0x7f800000, 0x7fc00000,
                                     0xffffffff, 0x80000000,
                                     0x7f7fffff, 0x00000001,
                                     0x3f800000, static_cast<uint32_t>(random.bits())};
            section->set<uint32_t>(random.below(words), hard[random.below(std::size(hard))]);
        }
        writeSections(path, sections);
        PreparedScene prepared;
        const SceneOptions options = smallPicture(6, 4, 2);
        if (!badInputOf([&] { prepared = loadSavedScene(path, options); }).empty()) continue;
        renderFilm(*device, prepared);
        rendered++;
    }
    return rendered;
}

TEST_F(SavedFaults, hostileContentsUnderRightHashesAreRefusedOrRender)
{
    const int rendered = renderHostileVariants(path, 984, 600);
    EXPECT_GT(rendered, 20);  // else nothing was shown about what passes
    EXPECT_LT(rendered, 400);
}

TEST_F(SavedInstanceFaults, hostileContentsUnderRightHashesAreRefusedOrRender)
{
    const int rendered = renderHostileVariants(path, 985, 400);
    EXPECT_GT(rendered, 20);
    EXPECT_LT(rendered, 300);
}

}  // namespace
}  // namespace sahl::testing
