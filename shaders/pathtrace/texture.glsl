// Textures: pictures looked up by texture coordinates, with a filter of our own, since that of hardware is
// not exact. Rows of a picture go down from the top, v goes up: (u, v) = (0, 0) is the lower left corner of
// the picture, (1, 1) the upper right one, and the centre of a texel is half a texel away from its borders.

// The four texels around a point, as they are stored.
struct TexelQuad
{
    uint lowerLeft;
    uint lowerRight;
    uint upperLeft;
    uint upperRight;
    float fx;  // share of those on the right, in [0,1]
    float fy;  // share of the upper ones
};

/// Takes a coordinate into [0, 1], onto the picture. What is not a number becomes 0.
float wrapped(float x, bool clamps)
{
    if (clamps) return x > 0.0f ? min2(x, 1.0f) : 0.0f;
    return absolute(x) < 8388608.0f ? x - floor(x) : 0.0f;  // beyond are whole numbers alone
}

/// The texel at place i of an axis, which may be one beside the picture.
uint texelPlace(int i, uint size, bool clamps)
{
    int last = int(size) - 1;
    if (i < 0) return clamps ? 0u : uint(last);
    if (i > last) return clamps ? uint(last) : 0u;
    return uint(i);
}

/// Texel (x, y), counted from the lower left.
uint texelAt(READ(Texture) map, uint x, uint y)
{
    return loadTextureTexel(map.firstTexel + ((map.height - 1u) - y) * map.width + x);
}

/// The texels that a lookup is made of; of the nearest texel alone four times that.
TexelQuad texelsAround(READ(Texture) map, float u, float v)
{
    bool nearest = (map.flags & TEXTURE_NEAREST) != 0u;
    bool clampS = (map.flags & TEXTURE_CLAMP_S) != 0u;
    bool clampT = (map.flags & TEXTURE_CLAMP_T) != 0u;
    vec3 uv = vec3(u, v, 1.0f);
    float x = wrapped(dot3(map.rowS, uv), clampS) * float(map.width);
    float y = wrapped(dot3(map.rowT, uv), clampT) * float(map.height);
    float left = floor(nearest ? x : x - 0.5f);
    float low = floor(nearest ? y : y - 0.5f);
    int step = nearest ? 0 : 1;
    uint x0 = texelPlace(int(left), map.width, clampS);
    uint x1 = texelPlace(int(left) + step, map.width, clampS);
    uint y0 = texelPlace(int(low), map.height, clampT);
    uint y1 = texelPlace(int(low) + step, map.height, clampT);
    TexelQuad quad;
    quad.lowerLeft = texelAt(map, x0, y0);
    quad.lowerRight = texelAt(map, x1, y0);
    quad.upperLeft = texelAt(map, x0, y1);
    quad.upperRight = texelAt(map, x1, y1);
    quad.fx = nearest ? 0.0f : (x - 0.5f) - left;
    quad.fy = nearest ? 0.0f : (y - 0.5f) - low;
    return quad;
}

/// Red, green and blue of a texel, linear, in [0,1].
vec3 texelColor(uint texel, bool srgb)
{
    uint red = texel & 255u;
    uint green = (texel >> 8u) & 255u;
    uint blue = (texel >> 16u) & 255u;
    if (srgb) {
        // The curve's values for 0 to 255 stand in front of all texels.
        return vec3(uintBitsToFloat(loadTextureTexel(red)), uintBitsToFloat(loadTextureTexel(green)),
                    uintBitsToFloat(loadTextureTexel(blue)));
    }
    return vec3(float(red), float(green), float(blue)) * 0.00392156886f;
}

float texelAlpha(uint texel) { return float(texel >> 24u) * 0.00392156886f; }

/// The colour of a texture at (u, v), linear.
///   number  of the texture, counted from 1
vec3 lookUpColor(uint number, float u, float v)
{
    Texture map = loadTexture(number - 1u);
    bool srgb = (map.flags & TEXTURE_SRGB) != 0u;
    TexelQuad quad = texelsAround(map, u, v);
    vec3 lower = texelColor(quad.lowerLeft, srgb) * (1.0f - quad.fx) + texelColor(quad.lowerRight, srgb) * quad.fx;
    vec3 upper = texelColor(quad.upperLeft, srgb) * (1.0f - quad.fx) + texelColor(quad.upperRight, srgb) * quad.fx;
    return lower * (1.0f - quad.fy) + upper * quad.fy;
}

float lookUpAlpha(uint number, float u, float v)
{
    TexelQuad quad = texelsAround(loadTexture(number - 1u), u, v);
    float lower = texelAlpha(quad.lowerLeft) * (1.0f - quad.fx) + texelAlpha(quad.lowerRight) * quad.fx;
    float upper = texelAlpha(quad.upperLeft) * (1.0f - quad.fx) + texelAlpha(quad.upperRight) * quad.fx;
    return lower * (1.0f - quad.fy) + upper * quad.fy;
}

/// Texture coordinates at the point of a triangle with these barycentric coordinates.
vec2 cornersUv(READ(TriangleCorners) corners, float b1, float b2)
{
    float b0 = (1.0f - b1) - b2;
    return vec2((corners.u0 * b0 + corners.u1 * b1) + corners.u2 * b2,
                (corners.v0 * b0 + corners.v1 * b1) + corners.v2 * b2);
}

vec2 triangleUv(READ(Primitive) triangle, float b1, float b2)
{
    if (triangle.shape == SHAPE_FLAT) return vec2(0.0f);
    return cornersUv(loadCorners(triangle.shape), b1, b2);
}

/// Texture coordinates of a sphere as of a globe: v goes from -Y to +Y, u around, with +Z in the middle.
///   n  unit direction from the centre, in the sphere's own space
vec2 sphereUv(vec3 n)
{
    float across = root(n.x * n.x + n.z * n.z);
    return vec2(0.5f + atan2Turns(n.x, n.z), 2.0f * atan2Turns(across, -n.y));
}

/// Whether a material has a hole at a point of a triangle: by a hit there is nothing then.
///   instanceMaterial  what takes the place of the triangle's own, or NO_MATERIAL
bool isCutOut(READ(Primitive) triangle, uint instanceMaterial, float b1, float b2)
{
    if (triangle.shape == SHAPE_SPHERE) return false;
    Material material =
        loadMaterial(instanceMaterial != NO_MATERIAL ? instanceMaterial : triangle.material);
    if (!(material.alphaCutoff > 0.0f) || material.baseColorTexture == NO_TEXTURE) return false;
    vec2 uv = triangleUv(triangle, b1, b2);
    return lookUpAlpha(material.baseColorTexture, uv.x, uv.y) < material.alphaCutoff;
}

/// Radiance of a material at (u, v) [W m^-2 sr^-1].
vec3 emittedAt(READ(Material) material, float u, float v)
{
    if (!HAS_TEXTURES || material.emissionTexture == NO_TEXTURE) return material.emission;
    return flushed3(material.emission * lookUpColor(material.emissionTexture, u, v));
}

/// Makes of a material what it is at (u, v): its numbers times those of its textures.
void textureMaterial(float u, float v, INOUT(Material) material)
{
    if (!HAS_TEXTURES) return;
    if (material.baseColorTexture != NO_TEXTURE)
        material.baseColor = material.baseColor * lookUpColor(material.baseColorTexture, u, v);
    material.emission = emittedAt(material, u, v);
    if (material.roughnessTexture != NO_TEXTURE) {
        vec3 share = lookUpColor(material.roughnessTexture, u, v);
        material.roughness = material.roughness * share.y;
        material.metallic = material.metallic * share.z;
    }
}
