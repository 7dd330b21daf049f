// Views and accessors: where numbers lie in buffers.
#include "scene/gltf_file.h"

#include <algorithm>
#include <array>
#include <bit>

namespace sahl {

namespace {

struct ElementType {
    const char* name;
    uint32_t components;
    uint32_t columns;  ///< of a matrix, each beginning at a multiple of 4 bytes
};

constexpr std::array<ElementType, 7> ELEMENT_TYPES = {{{"SCALAR", 1, 1},
                                                       {"VEC2", 2, 1},
                                                       {"VEC3", 3, 1},
                                                       {"VEC4", 4, 1},
                                                       {"MAT2", 4, 2},
                                                       {"MAT3", 9, 3},
                                                       {"MAT4", 16, 4}}};

/// Bytes of a component; 0 for what is no component type.
uint32_t componentSize(uint32_t componentType)
{
    switch (componentType) {
    case GLTF_BYTE:
    case GLTF_UBYTE:
        return 1;
    case GLTF_SHORT:
    case GLTF_USHORT:
        return 2;
    case GLTF_UINT:
    case GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

/// Bytes of an element: `whole` from one to the next when they are packed, `last` of the last one,
/// which needs nothing behind its last column.
struct ElementSize {
    uint32_t whole, last;
};

ElementSize elementSize(const ElementType& type, uint32_t componentType)
{
    const uint32_t column = type.components / type.columns * componentSize(componentType);
    const uint32_t padded = type.columns == 1 ? column : (column + 3) / 4 * 4;
    return {type.columns * padded, (type.columns - 1) * padded + column};
}

const ElementType& readElementType(const JsonObject& accessor)
{
    required(accessor, "type");
    const std::string name =
        accessor.choice("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
    return *std::find_if(ELEMENT_TYPES.begin(), ELEMENT_TYPES.end(),
                         [&](const ElementType& type) { return type.name == name; });
}

uint32_t readComponentType(const JsonObject& object)
{
    const uint32_t type = requiredUint(object, "componentType", 0, 0xffffffffu);
    if (componentSize(type) > 0) return type;
    throw errorAt(object.document(), object.at("componentType"),
                  fmt::format("\"componentType\" of {} is {}; known: 5120 to 5123, 5125, 5126",
                              object.what(), type));
}

/// Numbers of `count` elements in the view that `object` names, at its byteOffset.
GltfNumbers locate(const GltfFile& file, const JsonObject& object, uint32_t count, ElementSize size,
                   uint32_t componentType, bool isMatrix)
{
    const GltfView& view =
        file.views[requiredIndex(object, "bufferView", file.views.size(), "buffer views")];
    const uint32_t offset = object.uint("byteOffset", 0, 0, 0xffffffffu);
    const uint32_t bytes = componentSize(componentType);
    if (offset % (isMatrix ? 4 : bytes) != 0 || (uint64_t{offset} + view.offset) % bytes != 0) {
        throw errorAt(
            object.document(), object.node(),
            fmt::format("{} begins at byte {} of {}, which is at byte {} of its buffer; both "
                        "must be multiples of {}{}",
                        object.what(), offset, view.what, view.offset, bytes,
                        isMatrix ? ", for a matrix the first of 4" : ""));
    }
    GltfNumbers numbers;
    numbers.componentType = componentType;
    numbers.stride = view.stride > 0 ? view.stride : size.whole;
    if (numbers.stride < size.whole) {
        throw errorAt(object.document(), object.node(),
                      fmt::format("{} has elements of {} bytes, and the stride of {} is {}",
                                  object.what(), size.whole, view.what, view.stride));
    }
    const uint64_t end = offset + uint64_t{numbers.stride} * (count - 1) + size.last;
    if (end > view.bytes.size()) {
        throw errorAt(object.document(), object.node(),
                      fmt::format("{} ends at byte {} of {}, which has {}", object.what(), end,
                                  view.what, view.bytes.size()));
    }
    numbers.first = view.bytes.data() + offset;
    return numbers;
}

double numberAt(const GltfNumbers& numbers, uint32_t element, uint32_t component)
{
    const uint32_t size = componentSize(numbers.componentType);
    const uint8_t* at =
        numbers.first + uint64_t{element} * numbers.stride + uint64_t{component} * size;
    uint32_t bits = 0;
    for (uint32_t i = 0; i < size; i++) bits |= static_cast<uint32_t>(at[i]) << (8 * i);
    switch (numbers.componentType) {
    case GLTF_BYTE:
        return static_cast<int8_t>(bits);
    case GLTF_SHORT:
        return static_cast<int16_t>(bits);
    case GLTF_FLOAT:
        return std::bit_cast<float>(bits);
    default:
        return bits;
    }
}

/// The place of an element among those with other values; count when it is none of them.
uint32_t findSparse(const GltfSparse& sparse, uint32_t element)
{
    uint32_t lo = 0, hi = sparse.count;
    while (lo < hi) {
        const uint32_t middle = lo + (hi - lo) / 2;
        if (numberAt(sparse.indices, middle, 0) < element)
            lo = middle + 1;
        else
            hi = middle;
    }
    const bool found = lo < sparse.count && numberAt(sparse.indices, lo, 0) == element;
    return found ? lo : sparse.count;
}

void checkSparseIndices(const JsonObject& indices, const GltfSparse& sparse, uint32_t elements)
{
    double previous = -1;
    for (uint32_t i = 0; i < sparse.count; i++) {
        const double index = numberAt(sparse.indices, i, 0);
        if (!(index > previous && index < elements)) {
            throw errorAt(
                indices.document(), indices.node(),
                fmt::format("index {} of {} is {}; they must rise, and there are {} elements", i,
                            indices.what(), index, elements));
        }
        previous = index;
    }
}

GltfSparse readSparse(const GltfFile& file, const JsonObject& object, const GltfAccessor& accessor,
                      ElementSize size, bool isMatrix)
{
    GltfSparse sparse;
    sparse.count = requiredUint(object, "count", 1, accessor.count);
    for (const char* key : {"indices", "values"}) {
        required(object, key);
        const JsonObject part = *childOf(object, key);
        const uint32_t view = requiredIndex(part, "bufferView", file.views.size(), "buffer views");
        if (file.views[view].stride > 0) {
            throw errorAt(
                file.document, part.node(),
                fmt::format("{}: {} must not have a stride", part.what(), file.views[view].what));
        }
    }
    const JsonObject indices = *childOf(object, "indices");
    const uint32_t type = readComponentType(indices);
    if (type != GLTF_UBYTE && type != GLTF_USHORT && type != GLTF_UINT) {
        throw errorAt(file.document, indices.at("componentType"),
                      fmt::format("{} must be whole numbers without sign", indices.what()));
    }
    const uint32_t bytes = componentSize(type);
    sparse.indices = locate(file, indices, sparse.count, {bytes, bytes}, type, false);
    sparse.values = locate(file, *childOf(object, "values"), sparse.count, size,
                           accessor.numbers.componentType, isMatrix);
    checkSparseIndices(indices, sparse, accessor.count);
    return sparse;
}

GltfAccessor readAccessor(const GltfFile& file, const JsonNode& node, size_t index)
{
    GltfAccessor accessor;
    accessor.what = fmt::format("accessor {}", index);
    accessor.node = &node;
    const JsonObject object(file.document, node, accessor.what);
    const ElementType& type = readElementType(object);
    const uint32_t componentType = readComponentType(object);
    const ElementSize size = elementSize(type, componentType);
    accessor.type = type.name;
    accessor.components = type.components;
    accessor.count = requiredUint(object, "count", 1, 0xffffffffu);
    accessor.normalized = object.boolean("normalized", false);
    if (accessor.normalized && componentSize(componentType) == 4) {
        throw errorAt(file.document, object.at("normalized"),
                      fmt::format("{} is normalized, which only numbers of 8 or 16 bits can be",
                                  accessor.what));
    }
    accessor.numbers.componentType = componentType;
    accessor.view = indexOf(object, "bufferView", file.views.size(), "buffer views");
    if (accessor.view) {
        accessor.numbers =
            locate(file, object, accessor.count, size, componentType, type.columns > 1);
    } else if (object.has("byteOffset")) {
        throw errorAt(file.document, object.at("byteOffset"),
                      fmt::format("{} has \"byteOffset\" and no \"bufferView\"", accessor.what));
    } else if (accessor.count > MAX_ZERO_ELEMENTS) {
        throw errorAt(
            file.document, object.at("count"),
            fmt::format("{} has {} elements and no \"bufferView\"; at most {} can be without",
                        accessor.what, accessor.count, MAX_ZERO_ELEMENTS));
    }
    if (const auto sparse = childOf(object, "sparse"))
        accessor.sparse = readSparse(file, *sparse, accessor, size, type.columns > 1);
    return accessor;
}

GltfView readView(const GltfFile& file, const JsonNode& node, size_t index)
{
    GltfView view;
    view.what = fmt::format("buffer view {}", index);
    const JsonObject object(file.document, node, view.what);
    const uint32_t buffer = requiredIndex(object, "buffer", file.buffers.size(), "buffers");
    const std::span<const uint8_t> bytes = file.buffers[buffer];
    const uint32_t length = requiredUint(object, "byteLength", 1, 0xffffffffu);
    view.offset = object.uint("byteOffset", 0, 0, 0xffffffffu);
    if (uint64_t{view.offset} + length > bytes.size()) {
        throw errorAt(file.document, node,
                      fmt::format("{} ends at byte {} of buffer {}, which has {}", view.what,
                                  uint64_t{view.offset} + length, buffer, bytes.size()));
    }
    view.bytes = bytes.subspan(view.offset, length);
    view.stride = object.uint("byteStride", 0, 4, 252);
    if (view.stride % 4 != 0) {
        throw errorAt(file.document, object.at("byteStride"),
                      fmt::format("the stride of {} is {}, which is no multiple of 4", view.what,
                                  view.stride));
    }
    return view;
}

}  // namespace

void readGltfViews(GltfFile& file)
{
    const auto& items = itemsOf(file.root(), "bufferViews");
    for (size_t i = 0; i < items.size(); i++) file.views.push_back(readView(file, items[i], i));
}

void readGltfAccessors(GltfFile& file)
{
    // Each sparse element takes a byte at least, and no honest file uses one twice: so the work of
    // checking them is bounded by the size of the file, however many accessors share a view.
    uint64_t bytes = 0, sparse = 0;
    for (const std::span<const uint8_t>& buffer : file.buffers) bytes += buffer.size();
    const auto& items = itemsOf(file.root(), "accessors");
    for (size_t i = 0; i < items.size(); i++) {
        file.accessors.push_back(readAccessor(file, items[i], i));
        if (const auto& last = file.accessors.back().sparse) sparse += last->count;
        if (sparse > bytes) {
            throw errorAt(
                file.document, items[i],
                fmt::format("the sparse accessors have more elements than the buffers have "
                            "bytes, {}",
                            bytes));
        }
    }
}

double gltfNumber(const GltfAccessor& accessor, uint32_t element, uint32_t component)
{
    const GltfNumbers* numbers = &accessor.numbers;
    if (accessor.sparse) {
        const uint32_t other = findSparse(*accessor.sparse, element);
        if (other < accessor.sparse->count) {
            numbers = &accessor.sparse->values;
            element = other;
        }
    }
    if (!numbers->first) return 0;
    const double value = numberAt(*numbers, element, component);
    if (!accessor.normalized) return value;
    switch (numbers->componentType) {
    case GLTF_BYTE:
        return std::max(value / 127, -1.0);
    case GLTF_SHORT:
        return std::max(value / 32767, -1.0);
    case GLTF_UBYTE:
        return value / 255;
    default:
        return value / 65535;
    }
}

}  // namespace sahl
