// Reads nested JSON as it comes, event by event, so that neither its size nor its depth takes stack
// or a second copy.
#include "saved/saved_scene.h"

#include "saved/check.h"
#include "saved/description.h"
#include "saved/struct_json.h"
#include "saved/tree_assembly.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

namespace sahl {

namespace {

constexpr uint64_t MAX_TREE_BYTES = uint64_t{2} << 30;
constexpr uint64_t TREE_VERSION = 1;

/// The text for the parser, which tells how far it got.
struct Cursor {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char* at;
    size_t* consumed;

    reference operator*() const { return *at; }
    Cursor& operator++()
    {
        ++at;
        ++*consumed;
        return *this;
    }
    bool operator==(const Cursor& other) const { return at == other.at; }
    bool operator!=(const Cursor& other) const { return at != other.at; }
};

/// A leaf while its keys are being read.
struct Leaf {
    enum Key : uint { type, number, material, p0, p1, p2, normals, center, radius };
    static constexpr const char* NAMES[] = {"type", "number",  "material", "p0",    "p1",
                                            "p2",   "normals", "center",   "radius"};
    static constexpr size_t KEY_COUNT = std::size(NAMES);
    static constexpr uint COMMON = 1u << type | 1u << number | 1u << material;
    static constexpr uint TRIANGLE = COMMON | 1u << p0 | 1u << p1 | 1u << p2;
    static constexpr uint SPHERE = COMMON | 1u << center | 1u << radius;

    Primitive primitive = {};
    TriangleNormals corners = {};
    bool isSphere = false;
    uint given = 0;  ///< bits of the keys so far
    Key key = type;  ///< whose value is expected or under way
};

class TreeReader : public nlohmann::json_sax<nlohmann::json> {
public:
    TreeReader(const std::string& file, std::string_view text, const SceneOptions& options,
               PreparedScene& prepared)
        : file_(file), text_(text), options_(options), prepared_(prepared)
    {
    }

    void read()
    {
        const char* begin = text_.data();
        sax_parse(begin, begin + text_.size());
        prepared_.bvh.nodes = std::move(tree_.bvh.nodes);
        prepared_.bvh.primitives = std::move(tree_.bvh.primitives);
        prepared_.bvh.rootRef = tree_.bvh.rootRef;
        const BvhBuild build = prepared_.bvh.statistics.build;
        prepared_.bvh.statistics = tree_.bvh.statistics;
        prepared_.bvh.statistics.build = build;
        prepared_.bvh.statistics.primitivesSeen = prepared_.bvh.primitives.size();
    }

    bool null() override { return wordOrNull(); }
    bool boolean(bool) override { return wordOrNull(); }
    bool number_integer(number_integer_t value) override
    {
        return value < 0 ? real(static_cast<float>(value)) : whole(static_cast<uint64_t>(value));
    }
    bool number_unsigned(number_unsigned_t value) override { return whole(value); }
    bool number_float(number_float_t value, const string_t& text) override
    {
        float number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc::result_out_of_range) {
            if (std::abs(value) > 1) throw wrong("\"" + text + "\" is beyond the range of numbers");
            number = 0;
        }
        return real(number);
    }
    bool string(string_t& value) override
    {
        if (isWithinScene()) return true;
        if (!inLeaf_ || leaf_.key != Leaf::type || depth_ != 0)
            throw wrong("a text is out of place");
        if (value != "triangle" && value != "sphere") {
            throw wrong("\"type\" of a leaf is \"" + value + "\"; known: \"triangle\", \"sphere\"");
        }
        leaf_.isSphere = value == "sphere";
        return true;
    }
    bool binary(binary_t&) override { return false; }  // not part of JSON text

    bool start_object(std::size_t) override
    {
        if (part_ == Part::scene) return descend();
        if (part_ == Part::file && keysRead_ == 0 && !fileOpen_) {
            fileOpen_ = true;
            return true;
        }
        if (part_ != Part::root || inLeaf_ || groups_ == 0)
            throw wrong("an object is out of place");
        leaf_ = {};
        inLeaf_ = true;
        return true;
    }

    bool end_object() override
    {
        if (part_ == Part::scene) return ascend();
        if (inLeaf_) {
            finishLeaf();
            return true;
        }
        if (keysRead_ != std::size(KEYS)) {
            throw wrong(fmt::format("the key \"{}\" is missing", KEYS[keysRead_]));
        }
        return true;
    }

    bool start_array(std::size_t) override
    {
        if (isWithinScene()) return descend();
        if (part_ == Part::file) throw wrong("an array is out of place");
        const bool isGroup = part_ == Part::root && !inLeaf_;
        if (isGroup) {
            placed([&] { tree_.openGroup(); });
            groups_++;
            return true;
        }
        const size_t deepest = inLeaf_ ? (leaf_.key == Leaf::normals ? 2 : 1) : 2;
        const bool allowed = !inLeaf_ || leaf_.key >= Leaf::p0;
        if (!allowed || (inLeaf_ && leaf_.key == Leaf::radius) || depth_ == deepest) {
            throw wrong("an array is out of place");
        }
        depth_++;
        return true;
    }

    bool end_array() override
    {
        if (part_ == Part::scene) return ascend();
        if (part_ == Part::root && !inLeaf_) {
            placed([&] { tree_.closeGroup(); });
            groups_--;
            if (groups_ == 0) part_ = Part::file;
            return true;
        }
        depth_--;
        if (inLeaf_) {
            if (depth_ == 0) {
                finishVectors();
            } else if (numberCount_ != 3 * ++vectors_) {
                throw wrong("a normal needs 3 numbers");
            }
        } else if (depth_ == 1) {
            finishTexel();
        } else {
            part_ = Part::file;
        }
        return true;
    }

    bool key(string_t& name) override
    {
        if (part_ == Part::scene) return true;
        if (inLeaf_) {
            beginLeafKey(name);
            return true;
        }
        if (keysRead_ == std::size(KEYS) || name != KEYS[keysRead_]) {
            throw wrong(keysRead_ == std::size(KEYS)
                            ? "no key may follow \"root\""
                            : fmt::format("the key \"{}\" where \"{}\" is expected", name,
                                          KEYS[keysRead_]));
        }
        keysRead_++;
        part_ = PARTS[keysRead_ - 1];
        return true;
    }

    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override
    {
        // "[json.exception...] parse error at line 1, column 2: syntax error while ..."
        std::string why = error.what();
        const size_t column = why.find("column ");
        const size_t colon = column == std::string::npos ? column : why.find(": ", column);
        if (colon != std::string::npos) why = why.substr(colon + 2);
        if (why.starts_with("[json.exception")) why = why.substr(why.find("] ") + 2);
        throw badInput("{}: {}", where(position > 0 ? position - 1 : 0), why);
    }

private:
    /// Where in the file the parser is: the values of its keys, or between them.
    enum class Part { file, scene, texels, root };
    static constexpr const char* KEYS[] = {"sahlTree", "scene", "texels", "root"};
    static constexpr Part PARTS[] = {Part::file, Part::scene, Part::texels, Part::root};

    void sax_parse(const char* begin, const char* end)
    {
        nlohmann::json::sax_parse(Cursor{begin, &consumed_}, Cursor{end, &consumed_}, this);
    }

    std::string where(size_t offset) const
    {
        const std::string_view before = text_.substr(0, std::min(offset, text_.size()));
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const size_t lineStart = before.rfind('\n');
        return fmt::format("{}:{}:{}", file_, line,
                           before.size() - (lineStart == std::string::npos ? 0 : lineStart + 1) +
                               1);
    }

    Error wrong(const std::string& finding) const
    {
        return badInput("{}: {}; docs/saved_scenes.md describes the format",
                        where(consumed_ > 0 ? consumed_ - 1 : 0), finding);
    }

    template <class Action>
    void placed(Action action) const
    {
        try {
            action();
        } catch (const Error& error) {
            throw wrong(error.what());
        }
    }

    /// Inside the object "scene", whose values are looked at later.
    bool isWithinScene() const
    {
        if (part_ != Part::scene) return false;
        if (depth_ == 0) throw wrong("\"scene\" must be an object");
        return true;
    }

    bool wordOrNull() const
    {
        if (isWithinScene()) return true;
        throw wrong("a word is out of place");
    }

    bool descend()
    {
        if (depth_ == 0) sceneBegin_ = consumed_ - 1;
        if (depth_ == MAX_JSON_DEPTH) {
            throw wrong(fmt::format("nested deeper than {} levels", MAX_JSON_DEPTH));
        }
        depth_++;
        return true;
    }

    bool ascend()
    {
        depth_--;
        if (depth_ > 0) return true;
        if (consumed_ > MAX_JSON_BYTES) {
            throw wrong(fmt::format("\"scene\" ends behind the first {} bytes", MAX_JSON_BYTES));
        }
        part_ = Part::file;
        readScene();
        return true;
    }

    bool whole(uint64_t value)
    {
        if (isWithinScene()) return true;
        if (part_ == Part::file) {
            if (keysRead_ == 1 && value == TREE_VERSION) return true;
            throw wrong(fmt::format("version {} of the format; this program reads version {}",
                                    value, TREE_VERSION));
        }
        const bool isIndex = inLeaf_ && (leaf_.key == Leaf::number || leaf_.key == Leaf::material);
        if (!isIndex) return real(static_cast<float>(value));
        if (value > std::numeric_limits<uint32_t>::max()) {
            throw wrong(fmt::format("{} is beyond the range of indices", value));
        }
        (leaf_.key == Leaf::number ? leaf_.primitive.number : leaf_.primitive.material) =
            static_cast<uint>(value);
        return true;
    }

    bool real(float value)
    {
        if (isWithinScene()) return true;
        const bool isRadius = inLeaf_ && leaf_.key == Leaf::radius;
        if (isRadius) {
            leaf_.primitive.p1.x = value;
            return true;
        }
        const size_t deep = inLeaf_ && leaf_.key != Leaf::normals ? 1 : 2;
        const bool inVector = part_ == Part::texels ? depth_ == 2 : inLeaf_ && depth_ == deep;
        if (!inVector) throw wrong("a number is out of place");
        if (numberCount_ == numbers_.size()) throw wrong("too many numbers");
        numbers_[numberCount_++] = value;
        return true;
    }

    vec3 vectorAt(size_t index) const
    {
        return {numbers_[3 * index], numbers_[3 * index + 1], numbers_[3 * index + 2]};
    }

    void requireNumbers(size_t count)
    {
        if (numberCount_ != count) {
            throw wrong(fmt::format("{} numbers where {} are expected", numberCount_, count));
        }
        numberCount_ = 0;
    }

    void finishTexel()
    {
        requireNumbers(3);
        prepared_.scene.probeTexels.emplace_back(vectorAt(0), 0.0f);
    }

    void finishVectors()
    {
        requireNumbers(leaf_.key == Leaf::normals ? 9 : 3);
        vectors_ = 0;
        if (leaf_.key == Leaf::normals) {
            leaf_.corners = {vectorAt(0), 0, vectorAt(1), 0, vectorAt(2), 0};
        } else if (leaf_.key == Leaf::p0 || leaf_.key == Leaf::center) {
            leaf_.primitive.p0 = vectorAt(0);
        } else {
            (leaf_.key == Leaf::p1 ? leaf_.primitive.p1 : leaf_.primitive.p2) = vectorAt(0);
        }
    }

    void beginLeafKey(const std::string& name)
    {
        const auto found = std::find(std::begin(Leaf::NAMES), std::end(Leaf::NAMES), name);
        if (found == std::end(Leaf::NAMES)) {
            throw wrong(fmt::format("unknown key \"{}\" in a leaf", name));
        }
        leaf_.key = static_cast<Leaf::Key>(found - std::begin(Leaf::NAMES));
        if ((leaf_.given & 1u << leaf_.key) != 0) {
            throw wrong(fmt::format("duplicate key \"{}\"", name));
        }
        leaf_.given |= 1u << leaf_.key;
    }

    void finishLeaf()
    {
        inLeaf_ = false;
        const uint needed = leaf_.isSphere ? Leaf::SPHERE : Leaf::TRIANGLE;
        const uint optional = leaf_.isSphere ? 0 : 1u << Leaf::normals;
        for (uint key = 0; key < Leaf::KEY_COUNT; key++) {
            const uint bit = 1u << key;
            if ((needed & ~leaf_.given & bit) != 0) {
                throw wrong(fmt::format("a leaf lacks the key \"{}\"", Leaf::NAMES[key]));
            }
            if ((leaf_.given & ~needed & ~optional & bit) != 0) {
                throw wrong(fmt::format("a {} has no key \"{}\"",
                                        leaf_.isSphere ? "sphere" : "triangle", Leaf::NAMES[key]));
            }
        }
        std::vector<TriangleNormals>& normals = prepared_.scene.triangleNormals;
        leaf_.primitive.shape = leaf_.isSphere ? SHAPE_SPHERE : SHAPE_FLAT;
        if ((leaf_.given & 1u << Leaf::normals) != 0) {
            leaf_.primitive.shape = static_cast<uint>(normals.size());
            normals.push_back(leaf_.corners);
        }
        placed([&] { tree_.addLeaf(leaf_.primitive); });
    }

    /// The value of "scene", parsed once more by itself. What stands in front of it becomes blanks,
    /// so that messages name the right line and column.
    void readScene()
    {
        std::string text(text_.substr(0, consumed_));
        std::replace_if(
            text.begin(), text.begin() + static_cast<std::ptrdiff_t>(sceneBegin_),
            [](char c) { return c != '\n'; }, ' ');
        const JsonDocument document = parseJson(file_, text);
        readDescription(document, {"materials", "lights", "objectStarts"}, options_, prepared_);
        Scene& scene = prepared_.scene;
        const JsonNode& root = document.root;
        for (size_t i = 0; i < root.keys.size(); i++) {
            const std::string& name = root.keys[i].name;
            if (name != "materials" && name != "lights" && name != "objectStarts") continue;
            for (const JsonNode& item : readArray(document, root.items[i], "\"" + name + "\"")) {
                if (name == "materials") {
                    scene.materials.push_back(
                        readMaterialJson(document, item, scene.materialNames.emplace_back()));
                } else if (name == "lights") {
                    scene.lights.push_back(readLightJson(document, item));
                } else {
                    scene.objectStarts.push_back(
                        readUint(document, item, "an object's start", 0, MAX_PRIMITIVES));
                }
            }
        }
    }

    const std::string& file_;
    std::string_view text_;
    const SceneOptions& options_;
    PreparedScene& prepared_;

    size_t consumed_ = 0;  ///< [bytes]
    Part part_ = Part::file;
    bool fileOpen_ = false;
    size_t keysRead_ = 0;    ///< of the file itself
    size_t sceneBegin_ = 0;  ///< [bytes]
    size_t depth_ = 0;       ///< arrays (in "scene" also objects) within the present value
    size_t groups_ = 0;      ///< open ones
    bool inLeaf_ = false;
    Leaf leaf_;
    std::array<float, 9> numbers_ = {};
    size_t numberCount_ = 0;
    size_t vectors_ = 0;  ///< complete ones among them
    TreeAssembly tree_;
};

}  // namespace

PreparedScene loadTreeJson(const fs::path& path, const SceneOptions& options)
{
    const std::string file = path.string();
    const MappedFile mapped(path, MAX_TREE_BYTES);
    PreparedScene prepared;
    prepared.scene.name = file;
    TreeReader(file, {reinterpret_cast<const char*>(mapped.bytes().data()), mapped.bytes().size()},
               options, prepared)
        .read();
    const DeviceScene scene = prepared.deviceScene();
    checkArrays(file, scene, prepared.bvh.rootRef, prepared.scene.objectStarts);
    checkFrame(file, scene.frame, scene.probeTexels.size());
    replaceProbe(options, prepared);
    return prepared;
}

}  // namespace sahl
