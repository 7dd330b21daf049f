#include "saved/tree_json_sax.h"

#include "bvh/instances.h"
#include "saved/tree_joining.h"
#include "scene/json_document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace sahl {

namespace {

constexpr uint64_t TREE_VERSION = 1;
constexpr const char* KEYS[] = {"sahlTree", "scene", "texels", "objects", "root"};
constexpr size_t OBJECTS_KEY = 3;  // may be missing

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

}  // namespace

TreeEvents::TreeEvents(const std::string& file, std::string_view text, ReadScene readScene,
                       PreparedScene& prepared)
    : file_(file), text_(text), readScene_(std::move(readScene)), prepared_(prepared)
{
}

void TreeEvents::read()
{
    const char* begin = text_.data();
    nlohmann::json::sax_parse(Cursor{begin, &consumed_}, Cursor{begin + text_.size(), &consumed_},
                              this);
    const BvhBuild build = prepared_.bvh.statistics.build;
    prepared_.bvh = std::move(tree_.bvh);
    prepared_.bvh.statistics.build = build;
    placed([&] { joinTrees(prepared_.bvh, std::move(objects_), std::move(instances_)); });
}

/// Of the value under way, to begin a message with.
std::string TreeEvents::path() const
{
    if (part_ == Part::texels)
        return fmt::format("texels[{}]: ", prepared_.scene.probeTexels.size());
    if (part_ == Part::objects) return fmt::format("objects[{}]: ", objects_.size());
    return part_ == Part::root ? "root: " : "";
}

std::string TreeEvents::where(size_t offset) const
{
    const std::string_view before = text_.substr(0, std::min(offset, text_.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t lineStart = before.rfind('\n');
    return fmt::format("{}:{}:{}", file_, line,
                       before.size() - (lineStart == std::string::npos ? 0 : lineStart + 1) + 1);
}

Error TreeEvents::wrong(const std::string& finding) const
{
    return badInput("{}: {}{}; docs/saved_scenes.md describes the format",
                    where(consumed_ > 0 ? consumed_ - 1 : 0), path(), finding);
}

template <class Action>
bool TreeEvents::placed(Action action) const
{
    try {
        action();
    } catch (const Error& error) {
        throw wrong(error.what());
    }
    return true;
}

/// Inside the object "scene", whose values are looked at later.
bool TreeEvents::isWithinScene() const
{
    if (part_ != Part::scene) return false;
    if (depth_ == 0) throw wrong("\"scene\" must be an object");
    return true;
}

bool TreeEvents::wordOrNull() const
{
    if (isWithinScene()) return true;
    throw wrong("a word is out of place");
}

bool TreeEvents::descend()
{
    if (depth_ == 0) sceneBegin_ = consumed_ - 1;
    if (depth_ == MAX_JSON_DEPTH) {
        throw wrong(fmt::format("nested deeper than {} levels", MAX_JSON_DEPTH));
    }
    depth_++;
    return true;
}

bool TreeEvents::ascend()
{
    depth_--;
    if (depth_ > 0) return true;
    if (consumed_ > MAX_JSON_BYTES) {
        throw wrong(fmt::format("\"scene\" ends behind the first {} bytes", MAX_JSON_BYTES));
    }
    part_ = Part::file;
    readScene_(sceneBegin_, consumed_);
    return true;
}

bool TreeEvents::null()
{
    return wordOrNull();
}

bool TreeEvents::boolean(bool)
{
    return wordOrNull();
}

bool TreeEvents::number_integer(number_integer_t value)
{
    return value < 0 ? real(static_cast<float>(value))
                     : number_unsigned(static_cast<number_unsigned_t>(value));
}

bool TreeEvents::number_unsigned(number_unsigned_t value)
{
    if (isWithinScene()) return true;
    if (inLeaf_) return placed([&] { leaf_.whole(value); });
    if (part_ == Part::texels && depth_ == 1) return textureTexel(value);
    if (part_ != Part::file) return real(static_cast<float>(value));
    if (keysRead_ == 1 && value == TREE_VERSION) return true;
    throw wrong(fmt::format("version {} of the format; this program reads version {}", value,
                            TREE_VERSION));
}

bool TreeEvents::number_float(number_float_t value, const string_t& text)
{
    float number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc::result_out_of_range) {
        if (std::abs(value) > 1) throw wrong("\"" + text + "\" is beyond the range of numbers");
        number = 0;
    }
    return real(number);
}

bool TreeEvents::real(float value)
{
    if (isWithinScene()) return true;
    if (inLeaf_) return placed([&] { leaf_.real(value); });
    if (part_ != Part::texels || depth_ != 2) throw wrong("a number is out of place");
    if (components_ == 3) throw wrong("a texel of more than 3 numbers");
    texel_[components_++] = value;
    return true;
}

bool TreeEvents::textureTexel(uint64_t value)
{
    if (prepared_.scene.textures.empty()) throw wrong("a number is out of place: there are no textures");
    if (value > std::numeric_limits<uint32_t>::max())
        throw wrong(fmt::format("{} is no texel of a texture: it has more than 32 bits", value));
    prepared_.scene.textureTexels.push_back(static_cast<uint32_t>(value));
    return true;
}

bool TreeEvents::string(string_t& value)
{
    if (isWithinScene()) return true;
    if (!inLeaf_) throw wrong("a text is out of place");
    return placed([&] { leaf_.text(value); });
}

bool TreeEvents::binary(binary_t&)
{
    return false;  // not part of JSON text
}

bool TreeEvents::start_object(std::size_t)
{
    if (part_ == Part::scene) return descend();
    if (part_ == Part::file && keysRead_ == 0 && !fileOpen_) {
        fileOpen_ = true;
        return true;
    }
    if (inLeaf_ || groups_ == 0) throw wrong("an object is out of place");
    leaf_ = {};
    inLeaf_ = true;
    return true;
}

bool TreeEvents::end_object()
{
    if (part_ == Part::scene) return ascend();
    if (inLeaf_) {
        finishLeaf();
    } else if (keysRead_ != std::size(KEYS)) {
        const char* missing = keysRead_ == OBJECTS_KEY ? "root" : KEYS[keysRead_];
        throw wrong(fmt::format("the key \"{}\" is missing", missing));
    }
    return true;
}

bool TreeEvents::start_array(std::size_t)
{
    if (isWithinScene()) return descend();
    if (inLeaf_) return placed([&] { leaf_.openArray(); });
    if (part_ == Part::objects || part_ == Part::root) {
        openGroup();
        return true;
    }
    if (part_ != Part::texels || depth_ == 2) throw wrong("an array is out of place");
    depth_++;
    return true;
}

bool TreeEvents::end_array()
{
    if (part_ == Part::scene) return ascend();
    if (inLeaf_) return placed([&] { leaf_.closeArray(); });
    if (part_ == Part::objects || part_ == Part::root) {
        closeGroup();
        return true;
    }
    depth_--;
    if (depth_ == 1) {
        finishTexel();
    } else {
        part_ = Part::file;
    }
    return true;
}

bool TreeEvents::key(string_t& name)
{
    if (part_ == Part::scene) return true;
    if (inLeaf_) return placed([&] { leaf_.key(name); });
    fileKey(name);
    return true;
}

void TreeEvents::fileKey(const std::string& name)
{
    static constexpr Part PARTS[] = {Part::file, Part::scene, Part::texels, Part::objects,
                                     Part::root};
    if (keysRead_ == std::size(KEYS)) throw wrong("no key may follow \"root\"");
    if (keysRead_ == OBJECTS_KEY && name == "root") keysRead_++;
    if (name != KEYS[keysRead_]) {
        throw wrong(fmt::format("the key \"{}\" where \"{}\"{} is expected", name, KEYS[keysRead_],
                                keysRead_ == OBJECTS_KEY ? " or \"root\"" : ""));
    }
    part_ = PARTS[keysRead_];
    keysRead_++;
}

bool TreeEvents::parse_error(std::size_t position, const std::string&,
                             const nlohmann::detail::exception& error)
{
    // "[json.exception...] parse error at line 1, column 2: syntax error while ..."
    std::string why = error.what();
    const size_t column = why.find("column ");
    const size_t colon = column == std::string::npos ? column : why.find(": ", column);
    if (colon != std::string::npos) why = why.substr(colon + 2);
    if (why.starts_with("[json.exception")) why = why.substr(why.find("] ") + 2);
    throw badInput("{}: {}", where(position > 0 ? position - 1 : 0), why);
}

void TreeEvents::finishTexel()
{
    if (components_ != 3) {
        throw wrong(fmt::format("a texel has {} numbers where 3 are expected", components_));
    }
    prepared_.scene.probeTexels.push_back(texel_);
    components_ = 0;
}

void TreeEvents::finishLeaf()
{
    inLeaf_ = false;
    placed([&] { leaf_.finish(); });
    if (leaf_.isInstance()) return addInstance(leaf_.instance());
    Primitive primitive = leaf_.primitive();
    if (leaf_.hasCorners()) {
        std::vector<TriangleCorners>& corners = prepared_.scene.triangleCorners;
        primitive.shape = static_cast<uint>(corners.size());
        corners.push_back(leaf_.corners());
    }
    placed([&] { tree_.addLeaf(primitive); });
}

/// What is wrong with it, or nothing.
std::string TreeEvents::faultOf(const InstanceLeaf& leaf) const
{
    const ObjectInstance& o = leaf.instance;
    const size_t materials = prepared_.scene.materials.size();
    if (part_ != Part::root)
        return "is in an object, which cannot have any; \"root\" has all instances";
    if (leaf.number >= MAX_INSTANCES || instances_.size() == MAX_INSTANCES)
        return fmt::format("there may be {}, counted from 0", MAX_INSTANCES);
    if (leaf.object >= objects_.size())
        return fmt::format("\"object\" is {}, the file has {}", leaf.object, objects_.size());
    if (o.material != NO_MATERIAL && o.material >= materials)
        return fmt::format("\"material\" is {}, the scene has {}", o.material, materials);
    if (o.lo.x > o.hi.x || o.lo.y > o.hi.y || o.lo.z > o.hi.z)
        return "\"lo\" is above \"hi\"; a box needs corners in order";
    return "";
}

void TreeEvents::addInstance(const InstanceLeaf& leaf)
{
    const std::string fault = faultOf(leaf);
    if (!fault.empty()) throw wrong(fmt::format("instance {}: {}", leaf.number, fault));
    const Box box = {leaf.instance.lo, leaf.instance.hi};
    placed([&] { tree_.addInstance(leaf.number, box, costOfInstance(objects_[leaf.object])); });
    instances_.push_back(leaf);
}

void TreeEvents::openGroup()
{
    if (part_ == Part::objects && !listOpen_) {
        listOpen_ = true;
        return;
    }
    placed([&] { tree_.openGroup(); });
    groups_++;
}

void TreeEvents::closeGroup()
{
    if (groups_ == 0) {  // the end of the list of objects
        part_ = Part::file;
        return;
    }
    placed([&] { tree_.closeGroup(); });
    groups_--;
    if (groups_ > 0) return;
    if (part_ == Part::root) {
        part_ = Part::file;
    } else {
        finishObject();
    }
}

void TreeEvents::finishObject()
{
    if (tree_.bvh.primitives.empty()) throw wrong("there is nothing in it; leave it out");
    if (objects_.size() == MAX_INSTANCES)
        throw wrong(fmt::format("more than {} objects", MAX_INSTANCES));
    objects_.push_back(std::move(tree_.bvh));
    tree_ = {};
}

}  // namespace sahl
