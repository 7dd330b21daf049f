#include "saved/tree_leaf.h"

#include "util/error.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace sahl {

namespace {

constexpr const char* TYPE_WORDS[] = {"triangle", "sphere", "instance"};
constexpr uint TRIANGLE = 1;  // bits, in the order of the words
constexpr uint SPHERE = 2;
constexpr uint INSTANCE = 4;
constexpr uint ANY_TYPE = 7;

enum class Kind { word, index, number, vector, rows };  // rows: 3 vectors

struct LeafKey {
    const char* name;
    Kind kind;
    uint required;  ///< types that must have it
    uint optional;  ///< types that may have it
};

enum Key : size_t {
    type,
    number,
    material,
    p0,
    p1,
    p2,
    normals,
    u,
    v,
    center,
    radius,
    object,
    toObject,
    toWorld,
    translation,
    lo,
    hi
};
constexpr LeafKey KEYS[] = {
    {"type", Kind::word, ANY_TYPE, 0},
    {"number", Kind::index, ANY_TYPE, 0},
    {"material", Kind::index, TRIANGLE | SPHERE, INSTANCE},
    {"p0", Kind::vector, TRIANGLE, 0},
    {"p1", Kind::vector, TRIANGLE, 0},
    {"p2", Kind::vector, TRIANGLE, 0},
    {"normals", Kind::rows, 0, TRIANGLE},
    {"u", Kind::vector, 0, TRIANGLE},  // of the three corners
    {"v", Kind::vector, 0, TRIANGLE},
    {"center", Kind::vector, SPHERE, 0},
    {"radius", Kind::number, SPHERE, 0},
    {"object", Kind::index, INSTANCE, 0},
    {"toObject", Kind::rows, INSTANCE, 0},
    {"toWorld", Kind::rows, INSTANCE, 0},
    {"translation", Kind::vector, INSTANCE, 0},
    {"lo", Kind::vector, INSTANCE, 0},
    {"hi", Kind::vector, INSTANCE, 0},
};

/// How deep in arrays the numbers of a value are.
size_t depthOf(Kind kind)
{
    return kind == Kind::rows ? 2 : (kind == Kind::vector ? 1 : 0);
}

size_t numbersOf(Kind kind)
{
    return kind == Kind::rows ? 9 : 3;
}

}  // namespace

void TreeLeaf::key(const std::string& name)
{
    static_assert(std::size(KEYS) == MAX_KEYS);
    const auto found = std::find_if(std::begin(KEYS), std::end(KEYS),
                                    [&](const LeafKey& known) { return name == known.name; });
    if (found == std::end(KEYS)) throw badInput("unknown key \"{}\" in a leaf", name);
    key_ = static_cast<size_t>(found - std::begin(KEYS));
    if (has(key_)) throw badInput("duplicate key \"{}\"", name);
    given_ |= 1u << key_;
    values_[key_].count = 0;
    rows_ = 0;
}

void TreeLeaf::text(const std::string& value)
{
    if (KEYS[key_].kind != Kind::word || depth_ != 0) throw badInput("a text is out of place");
    const auto found = std::find(std::begin(TYPE_WORDS), std::end(TYPE_WORDS), value);
    if (found == std::end(TYPE_WORDS)) {
        throw badInput(
            "\"type\" of a leaf is \"{}\"; known: \"triangle\", \"sphere\", \"instance\"", value);
    }
    type_ = static_cast<size_t>(found - std::begin(TYPE_WORDS));
}

void TreeLeaf::whole(uint64_t value)
{
    if (KEYS[key_].kind != Kind::index || depth_ != 0) return real(static_cast<float>(value));
    if (value > std::numeric_limits<uint32_t>::max()) {
        throw badInput("{} is beyond the range of indices", value);
    }
    values_[key_].index = static_cast<uint>(value);
}

void TreeLeaf::real(float value)
{
    const Kind kind = KEYS[key_].kind;
    const bool isNumber = kind != Kind::word && kind != Kind::index;
    if (!isNumber || depth_ != depthOf(kind)) throw badInput("a number is out of place");
    Value& v = values_[key_];
    if (v.count == v.numbers.size()) throw badInput("too many numbers");
    v.numbers[v.count++] = value;
}

void TreeLeaf::openArray()
{
    if (depth_ == depthOf(KEYS[key_].kind)) throw badInput("an array is out of place");
    depth_++;
}

void TreeLeaf::closeArray()
{
    const LeafKey& key = KEYS[key_];
    const size_t count = values_[key_].count;
    depth_--;
    if (depth_ > 0) {
        if (count != 3 * ++rows_) throw badInput("a row of \"{}\" needs 3 numbers", key.name);
    } else if (count != numbersOf(key.kind)) {
        throw badInput("\"{}\" has {} numbers where {} are expected", key.name, count,
                       numbersOf(key.kind));
    }
}

void TreeLeaf::finish() const
{
    const uint bit = 1u << type_;
    for (size_t i = 0; i < std::size(KEYS); i++) {  // the type first, without which all is open
        const LeafKey& key = KEYS[i];
        const bool needed = (key.required & bit) != 0;
        if (needed && !has(i)) throw badInput("a leaf lacks the key \"{}\"", key.name);
        if (has(i) && ((key.required | key.optional) & bit) == 0) {
            throw badInput("a leaf of type \"{}\" has no key \"{}\"", TYPE_WORDS[type_], key.name);
        }
    }
}

vec3 TreeLeaf::vectorOf(size_t key, size_t row) const
{
    const std::array<float, 9>& n = values_[key].numbers;
    return {n[3 * row], n[3 * row + 1], n[3 * row + 2]};
}

bool TreeLeaf::isInstance() const
{
    return 1u << type_ == INSTANCE;
}

InstanceLeaf TreeLeaf::instance() const
{
    InstanceLeaf leaf = {values_[number].index, values_[object].index, {}};
    ObjectInstance& o = leaf.instance;
    o.material = has(material) ? values_[material].index : NO_MATERIAL;
    o.toObject0 = vectorOf(toObject, 0);
    o.toObject1 = vectorOf(toObject, 1);
    o.toObject2 = vectorOf(toObject, 2);
    o.toWorld0 = vectorOf(toWorld, 0);
    o.toWorld1 = vectorOf(toWorld, 1);
    o.toWorld2 = vectorOf(toWorld, 2);
    o.translation = vectorOf(translation);
    o.lo = vectorOf(lo);
    o.hi = vectorOf(hi);
    return leaf;
}

Primitive TreeLeaf::primitive() const
{
    Primitive p = {};
    p.number = values_[number].index;
    p.material = values_[material].index;
    if (1u << type_ == SPHERE) {
        p.shape = SHAPE_SPHERE;
        p.p0 = vectorOf(center);
        p.p1.x = values_[radius].numbers[0];
    } else {
        p.shape = SHAPE_FLAT;
        p.p0 = vectorOf(p0);
        p.p1 = vectorOf(p1);
        p.p2 = vectorOf(p2);
    }
    return p;
}

bool TreeLeaf::hasCorners() const
{
    return has(Key::normals) || has(Key::u) || has(Key::v);
}

TriangleCorners TreeLeaf::corners() const
{
    constexpr size_t key = Key::normals;
    const vec3 us = vectorOf(Key::u), vs = vectorOf(Key::v);
    return {vectorOf(key, 0), us.x, vectorOf(key, 1), us.y, vectorOf(key, 2), us.z, vs.x, vs.y, vs.z, 0};
}

}  // namespace sahl
