#include "scene/texture.h"

#include "image/tone_map.h"
#include "scene/numbers.h"
#include "util/error.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace sahl {

namespace {

/// Mean of red, green and blue over all texels, linear: also that of the texture over a period,
/// since a bilinear filter gives every texel the same weight.
vec3 meanColor(std::span<const uint32_t> texels, bool srgb)
{
    std::array<std::array<uint64_t, 256>, 3> counts = {};
    for (const uint32_t texel : texels) {
        for (size_t c = 0; c < 3; c++) counts[c][texel >> (8 * c) & 255]++;
    }
    glm::dvec3 sum(0.0);
    for (size_t value = 0; value < 256; value++) {
        const double linear = srgb ? linearFromSrgb(double(value) / 255) : double(value) / 255;
        for (int c = 0; c < 3; c++)
            sum[c] += linear * double(counts[static_cast<size_t>(c)][value]);
    }
    return toFloat(sum / double(texels.size()));
}

bool isSame(const Texture& a, const Texture& b)
{
    return std::memcmp(&a, &b, sizeof(Texture)) == 0;
}

}  // namespace

const std::array<uint32_t, SRGB_TABLE_SIZE>& srgbTable()
{
    static const auto table = [] {
        std::array<uint32_t, SRGB_TABLE_SIZE> bits = {};
        for (size_t i = 0; i < bits.size(); i++)
            bits[i] = std::bit_cast<uint32_t>(static_cast<float>(linearFromSrgb(double(i) / 255)));
        return bits;
    }();
    return table;
}

StoredPicture storePicture(Scene& scene, const TexelImage& image, const std::string& name)
{
    std::vector<uint32_t>& texels = scene.textureTexels;
    if (texels.empty()) texels.assign(srgbTable().begin(), srgbTable().end());
    if (texels.size() + image.rgba.size() > MAX_SCENE_TEXELS) {
        throw badInput(
            "{}: with its {} x {} texels the textures of the scene have more than {}; scale "
            "some of them down",
            name, image.width, image.height, MAX_SCENE_TEXELS);
    }
    const StoredPicture picture = {static_cast<uint32_t>(texels.size()), image.width, image.height};
    texels.insert(texels.end(), image.rgba.begin(), image.rgba.end());
    return picture;
}

StoredPicture pictureOnce(Scene& scene, const std::string& name,
                          const std::function<TexelImage()>& make)
{
    const auto found = scene.pictures.find(name);
    if (found != scene.pictures.end()) return found->second;
    const StoredPicture picture = storePicture(scene, make(), name);
    scene.pictures.emplace(name, picture);
    return picture;
}

StoredPicture pictureOfFile(Scene& scene, const fs::path& file)
{
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(file, error);
    return pictureOnce(scene, error ? file.string() : whole.string(),
                       [&] { return readTexels(file); });
}

uint32_t addTexture(Scene& scene, const StoredPicture& picture, const TextureLook& look)
{
    Texture texture = {};
    texture.firstTexel = picture.firstTexel;
    texture.width = picture.width;
    texture.height = picture.height;
    texture.flags = (look.srgb ? TEXTURE_SRGB : 0) | (look.clampS ? TEXTURE_CLAMP_S : 0) |
                    (look.clampT ? TEXTURE_CLAMP_T : 0) | (look.nearest ? TEXTURE_NEAREST : 0);
    texture.rowS = toFloat(look.rowS);
    texture.rowT = toFloat(look.rowT);
    texture.strength = toFloat(look.strength);
    const size_t texels = size_t{picture.width} * picture.height;
    texture.mean =
        meanColor(std::span(scene.textureTexels).subspan(picture.firstTexel, texels), look.srgb);
    const auto same = std::find_if(scene.textures.begin(), scene.textures.end(),
                                   [&](const Texture& other) { return isSame(texture, other); });
    const auto number = static_cast<uint32_t>(same - scene.textures.begin()) + 1;
    if (same != scene.textures.end()) return number;
    if (scene.textures.size() >= MAX_TEXTURES)
        throw badInput("{}: the materials have more than {} textures", scene.name, MAX_TEXTURES);
    scene.textures.push_back(texture);
    return number;
}

bool usesTextures(const Scene& scene)
{
    return !scene.textures.empty();
}

}  // namespace sahl
