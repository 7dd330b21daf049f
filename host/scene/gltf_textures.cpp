// The textures of a glTF file: which picture, and how it is continued. The pictures themselves are
// read once something uses them.
#include "scene/data_uri.h"
#include "scene/gltf_model.h"

namespace sahl {

namespace {

// sampler.magFilter, .wrapS and .wrapT
constexpr uint32_t NEAREST = 9728;
constexpr uint32_t CLAMP_TO_EDGE = 33071;
constexpr uint32_t MIRRORED_REPEAT = 33648;
constexpr uint32_t REPEAT = 10497;

GltfTexture readSampler(GltfFile& file, const JsonNode& node, size_t index)
{
    const JsonObject sampler(file.document, node, fmt::format("sampler {}", index));
    GltfTexture texture;
    texture.nearest = sampler.uint("magFilter", 9729, 0, 0xffffffffu) == NEAREST;
    sampler.uint("minFilter", 9729, 0, 0xffffffffu);
    for (const char* key : {"wrapS", "wrapT"}) {
        const uint32_t wrap = sampler.uint(key, REPEAT, 0, 0xffffffffu);
        (key[4] == 'S' ? texture.clampS : texture.clampT) = wrap == CLAMP_TO_EDGE;
        if (wrap == MIRRORED_REPEAT)
            leaveOut(file, "samplers that mirror are not read: their textures repeat");
    }
    return texture;
}

GltfImage readImage(GltfFile& file, const JsonNode& node, size_t index)
{
    GltfImage image;
    const JsonObject object(file.document, node, fmt::format("image {}", index));
    image.what = fmt::format("{}: image {}", file.document.file, index);
    if (object.has("uri") == object.has("bufferView")) {
        throw errorAt(file.document, node,
                      fmt::format("{} needs either \"uri\" or \"bufferView\"", object.what()));
    }
    object.string("mimeType", "");
    if (object.has("bufferView")) {
        required(object, "mimeType");
        const GltfView& view =
            file.views[requiredIndex(object, "bufferView", file.views.size(), "buffer views")];
        if (view.stride > 0) {
            throw errorAt(
                file.document, node,
                fmt::format("{} is in {}, which must not have a stride", object.what(), view.what));
        }
        image.bytes = view.bytes;
        return image;
    }
    const std::string uri = object.string("uri", "");
    const std::string where = fmt::format(
        "{}: \"uri\" of {}", file.document.where(object.at("uri").offset), object.what());
    if (isDataUri(uri))
        image.bytes = readGltfUri(file, object);
    else
        image.file =
            resolvePath(file.policy, folderOf(file.path), fileNameOfUri(uri, where), where);
    return image;
}

}  // namespace

void readGltfTextures(GltfModel& model)
{
    GltfFile& file = model.file;
    const JsonObject root = file.root();
    std::vector<GltfTexture> samplers;
    for (const JsonNode& item : itemsOf(root, "samplers"))
        samplers.push_back(readSampler(file, item, samplers.size()));
    for (const JsonNode& item : itemsOf(root, "images"))
        model.images.push_back(readImage(file, item, model.images.size()));
    for (const JsonNode& item : itemsOf(root, "textures")) {
        const JsonObject object(file.document, item,
                                fmt::format("texture {}", model.textures.size()));
        GltfTexture texture;
        if (const auto sampler = indexOf(object, "sampler", samplers.size(), "samplers"))
            texture = samplers[*sampler];
        texture.image = indexOf(object, "source", model.images.size(), "images");
        if (!texture.image)
            leaveOut(file, "a texture without image, or of a kind that is not read, is left out");
        model.textures.push_back(texture);
    }
}

}  // namespace sahl
