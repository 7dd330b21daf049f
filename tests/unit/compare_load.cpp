// Pictures for a comparison: what is read of each kind of file.
#include "compare/compare.h"
#include "support/exr_files.h"
#include "support/pictures.h"

namespace sahl {
namespace {

using namespace sahl::testing;

class CompareLoad : public ::testing::Test {
protected:
    LoadedPicture load(const std::string& name, const FileBytes& bytes) const
    {
        writeFileAtomically(folder_.path / name, bytes);
        return loadPicture(folder_.path / name);
    }

private:
    TemporaryFolder folder_;
};

TEST_F(CompareLoad, exr_comesWithVarianceSamplesAndAttributes)
{
    const Image image = numberedImage(3, 2);
    const std::vector<ImageChannel> channels = {{"samples.Y", {1, 2, 3, 4, 5, 6}},
                                                {"variance.Y", {.1f, .2f, .3f, .4f, .5f, .6f}}};
    const LoadedPicture picture = load("a.exr", encodeExr(image, {{"sahl.seed", "3"}}, channels));
    EXPECT_EQ(picture.format, "EXR");
    EXPECT_FALSE(picture.displayReferred);
    expectSameBits(picture.image, image);
    EXPECT_EQ(picture.samples, channels[0].values);
    EXPECT_EQ(picture.variance, channels[1].values);
    EXPECT_EQ(picture.metadata.at("sahl.seed"), "3");
}

TEST_F(CompareLoad, otherKinds_comeWithoutVariance)
{
    const Image image = numberedImage(3, 2);
    EXPECT_EQ(load("a.pfm", encodePfm(image)).format, "PFM");
    EXPECT_TRUE(load("a.exr", encodeExr(image, {})).variance.empty());
    ExrOptions options;
    options.channels = {"R", "G", "B", "variance.Y"};
    options.type = Imf::HALF;  // too coarse to be ours
    EXPECT_TRUE(load("half.exr", makeExr(image, options)).variance.empty());
    EXPECT_EQ(load("named.exr", encodePfm(image)).format,
              "PFM");  // what it is, not what it is called
}

TEST_F(CompareLoad, png_isDecodedBySrgb)
{
    const LoadedPicture picture =
        load("a.png", encodePng({1, 1, {0, 128, 255}}, {{"sahl.seed", "3"}}));
    EXPECT_TRUE(picture.displayReferred);
    EXPECT_EQ(picture.image.rgb[0], 0);
    EXPECT_NEAR(picture.image.rgb[1], 0.215861, 1e-6);
    EXPECT_EQ(picture.image.rgb[2], 1);
    EXPECT_EQ(picture.metadata.at("sahl.seed"), "3");
}

}  // namespace
}  // namespace sahl
