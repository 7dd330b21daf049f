// Nested JSON damaged at random: it is refused with its place, or is another scene that renders,
// and that is kept to the bit when it is saved again.
#include "faults/saved_faults.h"

namespace sahl::testing {
namespace {

class TreeJsonDamage : public ::testing::Test {
protected:
    /// A place in the text: in the trees rather than before them, where less can go wrong.
    size_t placeIn(const std::string& text)
    {
        const size_t trees = text.find("\"texels\"");
        return random.below(4) == 0 ? random.bits() % text.size()
                                    : trees + random.bits() % (text.size() - trees);
    }

    /// Replaces a number behind a random place, if there is any.
    void replaceNumber(std::string& text)
    {
        static const char* const HARD[] = {
            "0",     "-0.0", "1",     "-1",         "7",
            "1e38",  "1e39", "1e400", "4294967295", "4294967296",
            "1e-45", "0.5",  "null",  "1048576",    "18446744073709551616",
            "\"x\"", "[]",   "{}",    "2147483648", "[0,0,0]"};
        const size_t at = text.find_first_of("-0123456789", placeIn(text));
        if (at == std::string::npos) return;
        const size_t end = text.find_first_not_of("-+.e0123456789", at);
        text.replace(at, end - at, HARD[random.below(std::size(HARD))]);
    }

    std::string damaged(std::string text)
    {
        const size_t at = placeIn(text);
        const size_t length = 1 + random.bits() % std::min<size_t>(text.size() - at, 300);
        switch (random.below(8)) {
        case 0:
            text.resize(at);
            break;
        case 1:
            text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
            break;
        case 2:
            text[at] = "[]{},:\"-.0e9"[random.below(12)];
            break;
        case 3:
            text.erase(at, length);
            break;
        case 4:
            text.insert(placeIn(text), text.substr(at, length));
            break;
        default:
            replaceNumber(text);
            break;
        }
        return text;
    }

    /// Loads `count` damaged variants of the scene. Returns how many rendered.
    int renderDamaged(const std::string& scene, int count)
    {
        writeTreeJson(prepareText(scene), path);
        const std::string whole = readTextFile(path);
        const SceneOptions options = smallPicture(6, 4, 2);
        int rendered = 0;
        for (int i = 0; i < count; i++) {
            SCOPED_TRACE(i);
            std::ofstream(path, std::ios::binary) << damaged(whole);
            PreparedScene loaded;
            const std::string error = badInputOf([&] { loaded = loadTreeJson(path, options); });
            if (!error.empty()) {
                EXPECT_TRUE(error.starts_with(path.string() + ":")) << error;
                continue;
            }
            writeTreeJson(loaded, again);
            EXPECT_TRUE(renderFilm(*cpu, loadTreeJson(again, options)) == renderFilm(*cpu, loaded));
            rendered++;
        }
        return rendered;
    }

    Random random{2028};
    TemporaryFolder folder;
    fs::path path = folder.path / "x.json", again = folder.path / "again.json";
    std::unique_ptr<Device> cpu = makeCpuDevice({});
};

TEST_F(TreeJsonDamage, ofOneTreeIsRefusedOrRenders)
{
    const int rendered = renderDamaged(R"({
        "camera": {"eye": [0, 2, 6], "lookAt": [0, 0, 0]}, "film": {"width": 24, "height": 16},
        "shapes": [{"type": "sphere", "radius": 0.5},
                   {"type": "sphereMesh", "level": 1, "smooth": true, "center": [1, 0, 0]}],
        "lights": [{"type": "point", "position": [2, 3, 3], "intensity": [4, 5, 6]}],
        "environment": {"radiance": [0.4, 0.5, 0.6]}})",
                                       1000);
    EXPECT_GT(rendered, 20);  // else nothing was shown about what passes
    EXPECT_LT(rendered, 500);
}

TEST_F(TreeJsonDamage, ofObjectsAndInstancesIsRefusedOrRenders)
{
    const int rendered = renderDamaged(R"({
        "camera": {"eye": [0, 2, 6], "lookAt": [0, 0, 0]}, "film": {"width": 24, "height": 16},
        "groups": {"a": {"shapes": [{"type": "sphere"}]},
                   "b": {"shapes": [{"type": "sphereMesh", "level": 1},
                                    {"type": "instance", "of": "a"}]}},
        "shapes": [{"type": "sphere", "radius": 0.5},
                   {"type": "instance", "of": "a", "transform": {"translate": [3, 0, 0]}},
                   {"type": "instance", "of": "b"},
                   {"type": "instance", "of": "b", "transform": {"scale": [1, 2, -1]}},
                   {"type": "instance", "of": "a", "transform": {"scale": [1, 2, -1]}}],
        "environment": {"radiance": [0.4, 0.5, 0.6]}})",
                                       1000);
    EXPECT_GT(rendered, 20);
    EXPECT_LT(rendered, 500);
}

}  // namespace
}  // namespace sahl::testing
