// A leaf of nested JSON, put together from its keys and values as they come.
#pragma once

#include "shared/scene_types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace sahl {

/// An instance as text has it; rootRef and firstNumber follow from its object and are left 0.
struct InstanceLeaf {
    uint number = 0;  ///< of the instance
    uint object = 0;  ///< number of the object that it places
    ObjectInstance instance;
};

/// All functions throw badInput, without a place, for what no leaf has.
class TreeLeaf {
public:
    /// Between its braces: the key whose value comes next, and the pieces of that value.
    void key(const std::string& name);
    void text(const std::string& value);
    void whole(uint64_t value);
    void real(float value);
    void openArray();
    void closeArray();

    /// At its end: throws unless it has all keys of its type, and no others.
    void finish() const;

    // Once finished.
    bool isInstance() const;
    InstanceLeaf instance() const;
    Primitive primitive() const;  ///< a triangle as one without corners of its own
    bool hasCorners() const;      ///< normals or texture coordinates
    TriangleCorners corners() const;

private:
    static constexpr size_t MAX_KEYS = 17;

    struct Value {
        uint index = 0;
        std::array<float, 9> numbers = {};
        size_t count = 0;  ///< of numbers
    };

    bool has(size_t key) const { return (given_ & 1u << key) != 0; }
    vec3 vectorOf(size_t key, size_t row = 0) const;

    size_t type_ = 0;   ///< number of the word
    uint given_ = 0;    ///< bits of the keys so far
    size_t key_ = 0;    ///< whose value is expected or under way
    size_t depth_ = 0;  ///< open arrays of that value
    size_t rows_ = 0;   ///< of it that are complete
    std::array<Value, MAX_KEYS> values_;
};

}  // namespace sahl
