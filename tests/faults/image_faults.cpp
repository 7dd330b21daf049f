// Pictures that are damaged, hostile or no pictures at all: a right result or a badInput error
// that names the file, never a crash or a hang.
#include "support/assets.h"
#include "support/exr_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <map>

namespace sahl {
namespace {

using namespace sahl::testing;

/// Small valid files of every format and coding.
std::map<std::string, FileBytes> smallFiles()
{
    std::map<std::string, FileBytes> files;
    files["pfm"] = encodePfm(numberedImage(3, 2));
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1.5\n\n";
    files["hdr flat"] =
        bytesOf(head + "-Y 1 +X 3\n") + FileBytes{1, 2, 3, 136, 4, 5, 6, 136, 0, 0, 0, 0};
    files["hdr old"] = bytesOf(head + "-Y 2 +X 4\n") +
                       FileBytes{1, 2, 3, 136, 1, 1, 1, 3, 4, 5, 6, 136, 7, 8, 9, 136, 1, 1, 1, 2};
    files["hdr new"] = bytesOf(head + "-Y 1 +X 8\n") +
                       FileBytes{2, 2, 0, 8, 136, 1, 136, 2, 4, 1, 2, 3, 4, 132, 9, 136, 136};
    ExrOptions options;
    files["exr zip"] = makeExr(numberedImage(5, 3), options);
    options.compression = Imf::PIZ_COMPRESSION;
    files["exr piz"] = makeExr(numberedImage(5, 3), options);
    options.compression = Imf::DWAA_COMPRESSION;
    options.type = Imf::HALF;
    files["exr dwaa"] = makeExr(numberedImage(9, 9), options);
    options.compression = Imf::RLE_COMPRESSION;
    options.tileSize = 4;
    files["exr tiled"] = makeExr(numberedImage(6, 5), options);
    return files;
}

/// Reads what may be broken. A picture that comes out has the pixels that it claims.
void expectPictureOrError(const FileBytes& bytes)
{
    try {
        const Image image = readBytes(bytes);
        EXPECT_GT(image.width, 0u);
        EXPECT_GT(image.height, 0u);
        EXPECT_EQ(image.rgb.size(), size_t{3} * image.width * image.height);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::badInput);
        EXPECT_NE(std::string(error.what()).find("picture: "), std::string::npos) << error.what();
    }
}

class ImageFaults : public ::testing::Test {
protected:
    ImageFaults() { setQuiet(true); }
    ~ImageFaults() override { setQuiet(false); }
};

TEST_F(ImageFaults, readImage_readsTheUndamagedFiles)
{
    for (const auto& [name, bytes] : smallFiles()) EXPECT_EQ(errorOf(bytes), "") << name;
}

TEST_F(ImageFaults, readImage_refusesFilesCutAtAnyByte)
{
    for (const auto& [name, bytes] : smallFiles()) {
        for (size_t length = 0; length < bytes.size(); length++) {
            const FileBytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
            EXPECT_NE(errorOf(cut), "") << name << " cut to " << length;
        }
    }
}

TEST_F(ImageFaults, readImage_survivesFlippedBytes)
{
    std::mt19937 random(77);
    for (const auto& [name, bytes] : smallFiles()) {
        SCOPED_TRACE(name);
        for (int i = 0; i < 300; i++) {
            FileBytes damaged = bytes;
            damaged[random() % damaged.size()] ^= static_cast<uint8_t>(1 + random() % 255);
            expectPictureOrError(damaged);
        }
    }
}

TEST_F(ImageFaults, readImage_survivesNoiseBehindTheMagicNumber)
{
    std::mt19937 random(78);
    for (const std::string_view magic : {"PF\n", "#?RADIANCE\n", "\x76\x2f\x31\x01\x02"}) {
        for (int i = 0; i < 300; i++) {
            FileBytes bytes = bytesOf(magic);
            for (size_t k = random() % 300; k > 0; k--) {
                bytes.push_back(static_cast<uint8_t>(random()));
            }
            expectPictureOrError(bytes);
        }
    }
}

TEST_F(ImageFaults, readImage_refusesImpossibleSizes)
{
    const char* sizes[][2] = {
        {"0", "1"},       {"1", "0"},         {"-1", "1"},         {"1000000000", "1000000000"},
        {"40000", "1"},   {"32768", "32768"}, {"4294967297", "1"}, {"99999999999999999999", "1"},
        {"32768", "8192"}};
    for (const auto& [width, height] : sizes) {
        const std::string pfm = fmt::format("PF\n{} {}\n-1.0\n1234", width, height);
        const std::string hdr =
            fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n1234", height, width);
        EXPECT_NE(errorOf(bytesOf(pfm)), "") << width << " " << height;
        EXPECT_NE(errorOf(bytesOf(hdr)), "") << width << " " << height;
    }
}

/// Replaces the data window of a valid EXR file.
FileBytes withDataWindow(FileBytes bytes, const int32_t (&window)[4])
{
    const std::string_view name("dataWindow\0box2i\0\x10\0\0\0", 21);
    auto found = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    EXPECT_NE(found, bytes.end());
    std::memcpy(&*found + name.size(), window, sizeof window);
    return bytes;
}

TEST_F(ImageFaults, readExr_refusesImpossibleDataWindows)
{
    constexpr int32_t low = std::numeric_limits<int32_t>::min();
    constexpr int32_t high = std::numeric_limits<int32_t>::max();
    const int32_t windows[][4] = {{low, low, high, high}, {0, 0, -1, 5},      {0, 0, high, 0},
                                  {5, 5, 4, 4},           {high, 0, low, 0},  {0, 0, 32767, 32767},
                                  {low, 0, low + 4, 2},   {0, 0, 32767, 8191}};
    const FileBytes valid = encodeExr(numberedImage(5, 3), {});
    for (const auto& window : windows) {
        EXPECT_NE(errorOf(withDataWindow(valid, window)), "") << window[0] << " " << window[2];
    }
}

TEST_F(ImageFaults, readExr_refusesKindsThatItDoesNotRead)
{
    const FileBytes valid = encodeExr(numberedImage(5, 3), {});
    const struct {
        size_t byte;
        uint8_t value;
        const char* text;
    } cases[] = {
        {4, 1, "version 1"}, {5, 0x08, "deep"}, {5, 0x10, "multi-part"}, {7, 0x80, "flags"}};
    for (const auto& test : cases) {
        FileBytes bytes = valid;
        bytes[test.byte] = test.value;
        EXPECT_NE(errorOf(bytes).find(test.text), std::string::npos) << errorOf(bytes);
    }
}

TEST_F(ImageFaults, readExr_refusesChunkOffsetsThatPointAnywhere)
{
    ExrOptions options;
    options.compression = Imf::NO_COMPRESSION;
    const FileBytes valid = makeExr(numberedImage(2, 3), options);
    // An uncompressed row: y, size, 2 x 3 floats. The table of 3 offsets stands before the rows.
    const size_t table = valid.size() - 3 * (8 + 24) - 3 * 8;
    for (const uint64_t offset : {uint64_t{1}, uint64_t{1} << 63, ~uint64_t{0}, valid.size() - 1}) {
        FileBytes bytes = valid;
        std::memcpy(&bytes[table], &offset, 8);
        EXPECT_NE(errorOf(bytes), "") << offset;
    }
}

TEST_F(ImageFaults, readImage_refusesWhatIsNoPicture)
{
    EXPECT_EQ(errorOf({}), "the file is empty");
    EXPECT_NE(errorOf(bytesOf("v 0 0 0\n")).find("unknown kind"), std::string::npos);
    EXPECT_NE(errorOf(bytesOf("P6\n1 1\n255\nabc")).find("PNM"), std::string::npos);
    EXPECT_NE(errorOf(bytesOf("\x89PNG\r\n\x1a\n")).find("PNG"), std::string::npos);
}

TEST_F(ImageFaults, readImage_refusesWhatIsNoFile)
{
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder.path / "pipe").c_str(), 0600), 0);
    for (const fs::path& path : {folder.path, folder.path / "pipe", folder.path / "missing.exr",
                                 fs::path("/dev/zero"), fs::path("/dev/null"), fs::path()}) {
        try {
            readImage(path);
            ADD_FAILURE() << path << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::badInput);
            EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << error.what();
        }
    }
}

/// "128 x 85" or "refused" for every file of a folder of the assets.
std::map<std::string, std::string> outcomes(const fs::path& folder)
{
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(assetFolder() / folder)) {
        const std::string name = entry.path().filename().string();
        try {
            const Image image = readImage(entry.path());
            EXPECT_EQ(image.rgb.size(), size_t{3} * image.width * image.height) << name;
            all[name] = fmt::format("{} x {}", image.width, image.height);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::badInput) << name;
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
            all[name] = "refused";
        }
    }
    return all;
}

TEST_F(ImageFaults, readExr_refusesAllDamagedPicturesOfTheOpenExrProject)
{
    SAHL_REQUIRE_ASSET("bad/exr-openexr-images");
    const auto all = outcomes("bad/exr-openexr-images");
    EXPECT_GE(all.size(), 100u);
    for (const auto& [name, outcome] : all) EXPECT_EQ(outcome, "refused") << name;
}

TEST_F(ImageFaults, readExr_readsOddPicturesAndRefusesBrokenOnes)
{
    SAHL_REQUIRE_ASSET("bad/exr-tinyexr");
    SAHL_REQUIRE_ASSET("bad/exr-oiio");
    EXPECT_EQ(outcomes("bad/exr-oiio").at("bad.exr"), "64 x 64");
    const std::map<std::string, std::string> readable = {{"000-issue194.exr", "1024 x 1024"},
                                                         {"2by2.exr", "2 x 2"},
                                                         {"issue-160-piz-decode.exr", "420 x 32"},
                                                         {"piz-bug-issue-100.exr", "35 x 1"}};
    for (const auto& [name, outcome] : outcomes("bad/exr-tinyexr")) {
        auto found = readable.find(name);
        EXPECT_EQ(outcome, found != readable.end() ? found->second : "refused") << name;
    }
}

TEST_F(ImageFaults, readHdr_readsOddPicturesAndRefusesBrokenOnes)
{
    SAHL_REQUIRE_ASSET("bad/hdr-image-rs");
    SAHL_REQUIRE_ASSET("bad/hdr-oiio");
    const std::map<std::string, std::string> odd = {
        {"image1.hdr", "128 x 85"}, {"old-rle.hdr", "551 x 276"}, {"scale.hdr", "256 x 8"}};
    EXPECT_EQ(outcomes("bad/hdr-image-rs"), odd);
    for (const auto& [name, outcome] : outcomes("bad/hdr-oiio"))
        EXPECT_EQ(outcome, "refused") << name;
}

TEST_F(ImageFaults, readImage_refusesPnm)
{
    SAHL_REQUIRE_ASSET("bad/pnm-oiio");
    for (const auto& [name, outcome] : outcomes("bad/pnm-oiio"))
        EXPECT_EQ(outcome, "refused") << name;
}

}  // namespace
}  // namespace sahl
