// Damaged PLY files: each gives a sound mesh or a badInput error, never a crash or a hang.
#include "scene/ply_reader.h"
#include "support/gzip_files.h"
#include "support/ply_files.h"
#include "support/scene_files.h"
#include "support/soups.h"
#include "util/gzip.h"

#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

void expectSound(const Mesh& mesh)
{
    ASSERT_FALSE(mesh.triangles.empty());
    for (const vec3& p : mesh.positions) {
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
    for (const MeshTriangle& triangle : mesh.triangles) {
        ASSERT_EQ(triangle.material, 0u);
        for (size_t k = 0; k < 3; k++) {
            ASSERT_LT(triangle.position[k], mesh.positions.size());
            ASSERT_TRUE(triangle.normal[k] == SHAPE_FLAT ||
                        triangle.normal[k] < mesh.normals.size());
        }
    }
}

/// Reads quietly; true for a mesh, false for badInput; anything else fails the test.
bool reads(const fs::path& path)
{
    bool read = false;
    warningsOf([&] {
        badInputOf([&] {
            expectSound(readPly(path));
            read = true;
        });
    });
    return read;
}

/// Vertices with normals and colours, faces of 3 to 5 corners, a strip, and an unknown element.
std::string smallPly(PlyFormat format)
{
    const std::string elements =
        "comment for damage\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "element face 3\nproperty list uchar int vertex_indices\n"
        "element tristrips 1\nproperty list uchar int vertex_indices\n"
        "element other 1\nproperty list ushort double values\n";
    std::vector<PlyItem> items;
    for (double i = 0; i < 6; i++) {
        items.push_back(floats({std::cos(i), std::sin(i), i / 8, 0, 0, 1}));
    }
    items.push_back(face({0, 1, 2}));
    items.push_back(face({0, 1, 2, 3}));
    items.push_back(face({0, 1, 2, 3, 4}));
    items.push_back(face({0, 1, 2, -1, 3, 4, 5}));
    items.push_back({{PlyType::uint16, 1}, {PlyType::float64, 0.5}});
    return ply(format, elements, items);
}

void flipBits(std::string& bytes, Random& random)
{
    for (uint i = 0, count = 1 + random.below(4); i < count; i++) {
        char& c = bytes[random.below(static_cast<uint>(bytes.size()))];
        c = static_cast<char>(c ^ (1 << random.below(8)));
    }
}

class DamagedPly : public ::testing::TestWithParam<PlyFormat> {
protected:
    std::string small = smallPly(GetParam());
    SceneFolder files;
};

TEST_P(DamagedPly, undamagedFileIsRead)
{
    EXPECT_TRUE(reads(files.write("a.ply", small)));
}

TEST_P(DamagedPly, fileCutAnywhereIsRefused)
{
    for (size_t length = 0; length + 4 < small.size(); length++) {
        EXPECT_FALSE(reads(files.write("a.ply", small.substr(0, length)))) << length;
    }
}

TEST_P(DamagedPly, thousandFilesWithFlippedBitsAreReadOrRefused)
{
    Random random(7);
    int read = 0;
    for (int i = 0; i < 1000; i++) {
        std::string damaged = small;
        flipBits(damaged, random);
        SCOPED_TRACE(i);
        if (reads(files.write("a.ply", damaged))) read++;
    }
    EXPECT_GT(read, 30);
    EXPECT_LT(read, 970);
}

TEST_P(DamagedPly, thousandPackedFilesCutOrFlippedAreRefused)
{
    const std::string whole = packed(small);
    constexpr uint header = 10;  // of which name, time and system are not checked
    Random random(8);
    for (int i = 0; i < 1000; i++) {
        std::string damaged = whole;
        if (i % 2 == 0)
            damaged.resize(random.below(static_cast<uint>(whole.size())));
        else
            damaged[header + random.below(static_cast<uint>(whole.size()) - header)] ^= 4;
        const fs::path path = files.write("a.ply.gz", damaged);
        // A few bits between the data and its check sum have no meaning.
        if (reads(path)) {
            EXPECT_EQ(readUnpackedText(path, 1 << 20), small) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedPly, ::testing::ValuesIn(PLY_FORMATS));

TEST(PlyFaults, aFaceOfAMillionCornersIsCutInTime)
{
    std::string text = "ply\nformat ascii 1.0\n";
    text += "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list int int vertex_indices\nend_header\n"
            "0 0 0\n1 0 0\n1 1 0\n0 1 0\n1000000";
    for (int i = 0; i < 250000; i++) text += " 0 1 2 3";
    SceneFolder files;
    EXPECT_TRUE(reads(files.write("a.ply", text)));
}

TEST(PlyFaults, thingsThatAreNoFilesAreRefusedAtOnce)
{
    SceneFolder files;
    fs::create_symlink("/dev/zero", files.folder.path / "zero.ply");
    EXPECT_CONTAINS(errorOfFile(files, "zero.ply"), "not a regular file");
    EXPECT_CONTAINS(errorOfFile(files, "missing.ply.gz"), "missing.ply.gz: cannot read");
}

}  // namespace
}  // namespace sahl
