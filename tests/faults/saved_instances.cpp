// Saved scenes whose instances are damaged or hostile.
#include "faults/saved_faults.h"

namespace sahl::testing {
namespace {

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

TEST_F(SavedInstanceFaults, hostileContentsUnderRightHashesAreRefusedOrRender)
{
    const int rendered = renderHostileVariants(path, 985, 400);
    EXPECT_GT(rendered, 20);
    EXPECT_LT(rendered, 300);
}

}  // namespace
}  // namespace sahl::testing
