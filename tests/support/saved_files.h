// Saved scenes for tests: written to a folder of their own, compared array by array, and altered.
#pragma once

#include "saved/container.h"
#include "saved/saved_scene.h"
#include "support/render_scenes.h"
#include "support/scene_files.h"
#include "support/source_folder.h"

#include <cstring>

namespace sahl::testing {

/// A scene with some of everything that is saved: triangles with and without normals, spheres,
/// several materials, all kinds of lights, an environment and a background.
inline std::string richScene()
{
    return R"({
        "camera": {"eye": [0.5, 2, 6], "lookAt": [0, 0.5, 0], "fovDeg": 33.3,
                   "lensRadius": 0.02, "focusOn": "ball"},
        "film": {"width": 24, "height": 16},
        "integrator": {"samplesPerPixel": 9, "maxBounces": 5, "seed": 7,
                       "ambient": [0.1, 0.2, 0.3], "terms": ["ambient", "specular"],
                       "adaptive": {"rule": "none", "epsilon": 0.01, "minSamples": 3,
                                    "maxSamples": 77}},
        "materials": {"clay": {"type": "lambert", "baseColor": [0.7, 0.4, 0.2]},
                      "glass": {"type": "dielectric", "eta": 1.52},
                      "gold": {"type": "conductor", "metal": "gold"},
                      "mix": {"type": "report", "diffuseWeight": 0.3, "specularWeight": 0.6},
                      "lamp": {"type": "lambert", "emission": [3, 2, 1]}},
        "shapes": [{"type": "rectangle", "corner": [-4, 0, 4], "edgeU": [8, 0, 0],
                    "edgeV": [0, 0, -8], "material": "clay"},
                   {"type": "sphereMesh", "level": 2, "smooth": true, "material": "mix",
                    "center": [-1.5, 1, 0]},
                   {"type": "teapot", "subdivisions": 2, "material": "gold",
                    "transform": {"scale": 0.3, "translate": [1.6, 0, 0]}},
                   {"type": "sphere", "name": "ball", "center": [0, 0.7, 1], "radius": 0.7,
                    "material": "glass"},
                   {"type": "rectangle", "corner": [-1, 4, -1], "edgeU": [2, 0, 0],
                    "edgeV": [0, 0, 2], "material": "lamp"}],
        "lights": [{"type": "point", "position": [2, 3, 3], "intensity": [4, 5, 6]},
                   {"type": "spot", "position": [-2, 5, 2], "lookAt": [0, 0, 0],
                    "intensity": [9, 9, 9]},
                   {"type": "directional", "direction": [-1, -2, -1], "irradiance": [1, 1, 1]}],
        "environment": {"builtin": "studio", "rotateDeg": 40, "scale": 0.7},
        "background": {"radiance": [0.1, 0.2, 0.3]}})";
}

/// Objects placed several times, nested, mirrored, repainted.
inline fs::path instancesScene()
{
    return sourceFolder() / "tests/scenes/instances.json";
}

/// A teapot placed 20 times in rows, each turned and scaled differently.
inline std::string crowdScene()
{
    std::string placed;
    for (int i = 0; i < 20; i++) {
        placed += fmt::format(R"(, {{"type": "instance", "of": "pot", "transform": {{
            "scale": {}, "rotateDeg": {{"axis": [0, 1, 0], "angle": {}}},
            "translate": [{}, 0, {}]}}}})",
                              0.1 + 0.01 * i, 37 * i, i % 5 - 2, -(i / 5));
    }
    return R"({"camera": {"eye": [0, 3, 5], "lookAt": [0, 0, -1]},
        "film": {"width": 24, "height": 16}, "integrator": {"samplesPerPixel": 4},
        "groups": {"pot": {"shapes": [{"type": "teapot", "subdivisions": 2}]}},
        "shapes": [{"type": "rectangle", "corner": [-4, 0, 4], "edgeU": [8, 0, 0],
                    "edgeV": [0, 0, -9]})" +
           placed + R"(], "environment": {"radiance": [0.4, 0.5, 0.6]}})";
}

inline PreparedScene prepareText(const std::string& text, const SceneOptions& options = {})
{
    return prepareScene(loadJson(text, options), BvhBuild::automatic, 2);
}

template <class Element>
bool sameBytes(std::span<const Element> a, std::span<const Element> b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

inline void expectSameStatistics(const BvhStatistics& a, const BvhStatistics& b)
{
    EXPECT_EQ(a.innerNodes, b.innerNodes);
    EXPECT_EQ(a.leaves, b.leaves);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.largestLeaf, b.largestLeaf);
    EXPECT_EQ(a.sahCost, b.sahCost);
    EXPECT_EQ(a.primitivesSeen, b.primitivesSeen);
    EXPECT_EQ(a.build, b.build);
}

/// All but the order of the normals, which the JSON form does not keep.
inline void expectSameButNormals(const PreparedScene& a, const PreparedScene& b)
{
    const DeviceScene p = a.deviceScene(), q = b.deviceScene();
    EXPECT_TRUE(sameBytes(p.nodes, q.nodes));
    EXPECT_TRUE(sameBytes(p.materials, q.materials));
    EXPECT_TRUE(sameBytes(p.lights, q.lights));
    EXPECT_TRUE(sameBytes(p.probeTexels, q.probeTexels));
    EXPECT_TRUE(sameBytes(p.instances, q.instances));
    EXPECT_EQ(std::memcmp(&p.frame, &q.frame, sizeof(Frame)), 0);
    EXPECT_EQ(p.treeDepth, q.treeDepth);
    EXPECT_EQ(a.scene.materialNames, b.scene.materialNames);
    EXPECT_EQ(a.scene.objectStarts, b.scene.objectStarts);
    EXPECT_EQ(a.scene.droppedTriangles, b.scene.droppedTriangles);
    EXPECT_EQ(a.scene.settings.spp, b.scene.settings.spp);
    EXPECT_EQ(
        std::memcmp(&a.scene.settings.adaptive, &b.scene.settings.adaptive, sizeof(AdaptiveRule)),
        0);
    expectSameStatistics(a.bvh.statistics, b.bvh.statistics);

    ASSERT_EQ(p.primitives.size(), q.primitives.size());
    for (size_t i = 0; i < p.primitives.size(); i++) {
        Primitive x = p.primitives[i], y = q.primitives[i];
        if (x.shape < SHAPE_SPHERE && y.shape < SHAPE_SPHERE) {
            EXPECT_EQ(std::memcmp(&p.triangleCorners[x.shape], &q.triangleCorners[y.shape],
                                  sizeof(TriangleCorners)),
                      0)
                << i;
            x.shape = y.shape;
        }
        EXPECT_EQ(std::memcmp(&x, &y, sizeof(Primitive)), 0) << i;
    }
}

inline void expectSame(const PreparedScene& a, const PreparedScene& b)
{
    expectSameButNormals(a, b);
    EXPECT_TRUE(sameBytes(a.deviceScene().triangleCorners, b.deviceScene().triangleCorners));
    EXPECT_TRUE(sameBytes(a.deviceScene().primitives, b.deviceScene().primitives));
}

/// A section of a file with bytes of its own, to be altered.
struct OwnSection {
    std::string name;
    std::vector<std::byte> bytes;
    uint32_t elementBytes = 0;

    template <class Element>
    Element get(size_t index) const
    {
        Element element;
        std::memcpy(&element, bytes.data() + index * sizeof(Element), sizeof(Element));
        return element;
    }
    template <class Element>
    void set(size_t index, const Element& element)
    {
        std::memcpy(bytes.data() + index * sizeof(Element), &element, sizeof(Element));
    }
    void setText(const std::string& text)
    {
        const auto span = std::as_bytes(std::span(text));
        bytes.assign(span.begin(), span.end());
    }
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

inline std::vector<OwnSection> sectionsOf(const fs::path& path)
{
    const MappedFile file(path);
    std::vector<OwnSection> sections;
    for (const Section& section : readContainer(path.string(), file.bytes())) {
        sections.push_back(
            {section.name, {section.bytes.begin(), section.bytes.end()}, section.elementBytes});
    }
    return sections;
}

inline OwnSection& sectionNamed(std::vector<OwnSection>& sections, const std::string& name)
{
    for (OwnSection& section : sections) {
        if (section.name == name) return section;
    }
    throw std::runtime_error("no section " + name);
}

/// Writes the sections with right hashes, whatever is in them.
inline void writeSections(const fs::path& path, const std::vector<OwnSection>& own)
{
    std::vector<Section> sections;
    for (const OwnSection& section : own) {
        sections.push_back({section.name, section.bytes, section.elementBytes});
    }
    writeContainer(path, sections);
}

}  // namespace sahl::testing
