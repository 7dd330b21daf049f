// --crop: windows of a picture.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <bit>
#include <csignal>
#include <map>

namespace sahl::testing {
namespace {

using Box = Imath::Box2i;

/// All channels of an EXR, rows of its data window.
struct ExrFile {
    Box data, display;
    std::map<std::string, std::vector<float>> channels;
    std::string crop;

    explicit ExrFile(const fs::path& path)
    {
        Imf::InputFile file(path.c_str());
        data = file.header().dataWindow();
        display = file.header().displayWindow();
        auto* text = file.header().findTypedAttribute<Imf::StringAttribute>("sahl.crop");
        crop = text ? text->value() : "";
        const auto width = static_cast<size_t>(data.max.x - data.min.x + 1);
        const auto height = static_cast<size_t>(data.max.y - data.min.y + 1);
        Imf::FrameBuffer frame;
        const Imf::ChannelList& list = file.header().channels();
        for (auto channel = list.begin(); channel != list.end(); ++channel) {
            std::vector<float>& values = channels[channel.name()];
            values.resize(width * height);
            frame.insert(channel.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), data));
        }
        file.setFrameBuffer(frame);
        file.readPixels(data.min.y, data.max.y);
    }

    uint32_t bits(const std::string& channel, int x, int y) const
    {
        const int width = data.max.x - data.min.x + 1;
        const int at = (y - data.min.y) * width + x - data.min.x;
        return std::bit_cast<uint32_t>(channels.at(channel).at(static_cast<size_t>(at)));
    }
};

class Windows : public SceneFolderTest {
protected:
    /// Every channel of the window has the bits that the full picture has there.
    void expectWindow(const ExrFile& window, const ExrFile& full, const Box& where) const
    {
        EXPECT_EQ(window.data, where);
        EXPECT_EQ(window.display, full.display);
        EXPECT_EQ(window.channels.size(), full.channels.size());
        for (const auto& [name, values] : window.channels) {
            for (int y = where.min.y; y <= where.max.y; y++) {
                for (int x = where.min.x; x <= where.max.x; x++) {
                    ASSERT_EQ(window.bits(name, x, y), full.bits(name, x, y))
                        << name << " at " << x << ", " << y;
                }
            }
        }
    }
};

TEST_F(Windows, pixels_areThoseOfTheFullPictureInEveryLayer)
{
    ASSERT_EQ(render({"--spp", "20", "--aovs", "-o", "full.exr"}).exitCode, 0);
    const ExrFile full(folder / "full.exr");
    EXPECT_EQ(full.data, full.display);
    EXPECT_EQ(full.crop, "");
    EXPECT_GT(full.channels.size(), 15u);
    const std::pair<const char*, Box> windows[] = {
        {"5,3,7,6", Box({5, 3}, {11, 8})},
        {"0,0,16,12", Box({0, 0}, {15, 11})},
        {"15,11,1,1", Box({15, 11}, {15, 11})},
    };
    for (const auto& [text, box] : windows) {
        RunResult result =
            render({"--spp", "20", "--aovs", "--crop", text, "--tile", "4", "-o", "window.exr"});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_FALSE(has(result.err, "warning")) << result.err;
        const ExrFile window(folder / "window.exr");
        expectWindow(window, full, box);
        EXPECT_EQ(window.crop, text);
    }
}

TEST_F(Windows, otherFormats_holdTheWindowAlone)
{
    ASSERT_EQ(render({"-o", "full.pfm"}).exitCode, 0);
    ASSERT_EQ(render({"--crop", "5,3,7,6", "-o", "a.pfm", "-o", "a.png", "-o", "a.exr"}).exitCode,
              0);
    const Image full = readImage(folder / "full.pfm");
    for (const char* name : {"a.pfm", "a.exr"}) {
        const Image window = readImage(folder / name);
        ASSERT_EQ(window.width, 7u);
        ASSERT_EQ(window.height, 6u);
        for (size_t row = 0; row < 6; row++) {
            EXPECT_TRUE(std::equal(window.rgb.begin() + row * 21,
                                   window.rgb.begin() + row * 21 + 21,
                                   full.rgb.begin() + ((row + 3) * 16 + 5) * 3));
        }
    }
    const std::string png = textOf(folder / "a.png");
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x07\0\0\0\x06", 8)) << "width and height";
    EXPECT_HAS(png, "iTXtsahl.crop" + std::string(5, '\0') + "5,3,7,6");
}

TEST_F(Windows, partlyOutside_areClippedWithAWarning)
{
    RunResult result = render({"--crop", "10,4,100,100", "-o", "a.exr"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_HAS(result.err, "warning: --crop 10,4,100,100 reaches beyond the picture of 16 x 12 "
                           "pixels; 10,4,6,8 is rendered");
    EXPECT_EQ(ExrFile(folder / "a.exr").data, Box({10, 4}, {15, 11}));
    EXPECT_EQ(ExrFile(folder / "a.exr").crop, "10,4,6,8");
}

TEST_F(Windows, outsideOrMalformed_areUsageErrors)
{
    expectRefused(render({"--crop", "16,0,1,1"}), 2,
                  "--crop 16,0,1,1 lies outside the picture of 16 x 12 pixels");
    expectRefused(render({"--crop", "0,12,1,1"}), 2, "lies outside the picture");
    expectRefused(render({"--crop", "0,0,0,5"}), 2,
                  "--crop 0 is out of range; give a number from 1");
    expectRefused(render({"--crop", "-3,0,4,5"}), 2, "--crop -3 is out of range");
    expectRefused(render({"--crop", "0,0,4"}), 2, "--crop '0,0,4' is no window; give X,Y,W,H");
    expectRefused(render({"--crop", "0,0,4,5,6"}), 2, "is no window");
    expectRefused(render({"--crop", "0,0,4,x"}), 2, "--crop 'x' is not a whole number");
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(Windows, interruptedOnes_areSavedAtTheirPlace)
{
    RunningProgram program(SAHL_PROGRAM,
                           {"render", "ball.json", "--device", "cpu", "--crop", "5,3,7,6", "--spp",
                            "16777216", "--progress", "bar", "-o", "a.exr"},
                           here());
    ASSERT_TRUE(program.waitForError([](const std::string& text) { return has(text, " spp"); }));
    program.signal(SIGINT);
    EXPECT_EQ(program.finish().exitCode, 130);
    EXPECT_EQ(ExrFile(folder / "a.exr").data, Box({5, 3}, {11, 8}));
}

}  // namespace
}  // namespace sahl::testing
