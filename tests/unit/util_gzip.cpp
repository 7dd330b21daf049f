// Files packed with gzip: unpacked, or refused when damaged or a trap.
#include "support/gzip_files.h"
#include "support/temporary_folder.h"
#include "util/error.h"
#include "util/gzip.h"

#include <fstream>

namespace sahl {
namespace {

using namespace sahl::testing;

std::string unpackedFrom(const std::string& bytes, uint64_t maxBytes = uint64_t{1} << 30)
{
    static const TemporaryFolder folder;
    const fs::path path = folder.path / "file.gz";
    fs::remove(path);
    std::ofstream(path, std::ios::binary) << bytes;
    return readUnpackedText(path, maxBytes);
}

/// The text of the badInput error of unpacking; "" when there is none.
std::string errorOf(const std::string& bytes, uint64_t maxBytes = uint64_t{1} << 30)
{
    try {
        unpackedFrom(bytes, maxBytes);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::badInput);
        const std::string text = error.what();
        return text.substr(text.find("file.gz"));
    }
    return "";
}

std::string someText()
{
    std::string text;
    for (int i = 0; i < 200'000; i++) text += fmt::format("v {} {} {}\n", i, i * 7 % 1000, i % 7);
    return text;
}

TEST(Gzip, isUnpackedAndOtherFilesStayAsTheyAre)
{
    EXPECT_EQ(unpackedFrom(packed(someText())), someText());
    EXPECT_EQ(unpackedFrom(packed("")), "");
    EXPECT_EQ(unpackedFrom("plain"), "plain");
    EXPECT_EQ(unpackedFrom(""), "");
    EXPECT_EQ(unpackedFrom("\x1f"), "\x1f");
}

TEST(Gzip, severalMembersFollowOneAnother)
{
    EXPECT_EQ(unpackedFrom(packed("one ") + packed("two ") + packed("three")), "one two three");
}

TEST(Gzip, truncatedFilesAreRefusedWhereverTheyEnd)
{
    const std::string whole = packed(someText().substr(0, 500));
    for (size_t length = 2; length < whole.size(); length++) {
        EXPECT_TRUE(errorOf(whole.substr(0, length)).starts_with("file.gz: the gzip file is trunc"))
            << length;
    }
}

TEST(Gzip, everyFlippedBitThatMattersIsNoticed)
{
    const std::string text = someText().substr(0, 200);
    const std::string whole = packed(text);
    size_t noticed = 0;
    constexpr size_t header = 10;  // of which name, time and system are not checked
    for (size_t bit = 8 * header; bit < 8 * whole.size(); bit++) {
        std::string damaged = whole;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
        const std::string error = errorOf(damaged);
        if (error.empty()) {
            EXPECT_EQ(unpackedFrom(damaged), text) << bit;
        } else {
            EXPECT_TRUE(error.starts_with("file.gz: the gzip file is ")) << error;
            noticed++;
        }
    }
    EXPECT_GE(noticed + 7, 8 * (whole.size() - header));  // up to 7 bits fill the last byte
}

TEST(Gzip, bytesBehindTheEndAreRefused)
{
    EXPECT_EQ(errorOf(packed("x") + "more"),
              "file.gz: 4 bytes behind the end of the gzip data are none");
}

TEST(Gzip, whatUnpacksToTooMuchIsRefusedWithNumbers)
{
    const std::string bomb = packed(std::string(100 << 20, '\0'));
    ASSERT_LT(bomb.size(), 120'000u);
    EXPECT_EQ(errorOf(bomb),
              fmt::format("file.gz: unpacks to more than 67108864 bytes, from {}; if "
                          "that is right, unpack it with gunzip first",
                          bomb.size()));
    const std::string text = packed(someText());
    EXPECT_TRUE(
        errorOf(text, 1'000'000).starts_with("file.gz: unpacks to more than 1000000 bytes"));
}

TEST(Gzip, onlyTheLastExtensionIsTakenOff)
{
    EXPECT_EQ(withoutGz("a/b.ply.gz"), "a/b.ply");
    EXPECT_EQ(withoutGz("b.OBJ.GZ"), "b.OBJ");
    EXPECT_EQ(withoutGz("b.gz.ply"), "b.gz.ply");
    EXPECT_EQ(withoutGz("b"), "b");
}

}  // namespace
}  // namespace sahl
