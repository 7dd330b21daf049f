// --integrator, --terms, --shadows and --normals as users meet them.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

namespace sahl::testing {
namespace {

std::string attributeOf(const fs::path& path, const std::string& name)
{
    Imf::InputFile file(path.c_str());
    auto* attribute = file.header().findTypedAttribute<Imf::StringAttribute>(name.c_str());
    return attribute ? attribute->value() : "(none)";
}

class ShadingOptions : public SceneFolderTest {
protected:
    ShadingOptions()
    {
        writeText(folder / "mesh.obj",
                  "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\n"
                  "vn 0 0 1\nvn 1 0 1\nusemtl gloss\nf 1//1 2//2 3//1\nf 2//2 4//2 3//1\n");
        writeText(folder / "mesh.mtl", "newmtl gloss\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 4\n");
    }

    /// The picture of mesh.obj with more arguments.
    std::vector<float> picture(const Arguments& more)
    {
        Arguments arguments = {"render",   "mesh.obj", "--device", "cpu", "--width", "16",
                               "--height", "16",       "--spp",    "1",   "-o",      "mesh.exr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        RunResult result = sahl(arguments, here());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return readImage(folder / "mesh.exr").rgb;
    }
    std::string attribute(const std::string& name) const
    {
        return attributeOf(folder / "mesh.exr", name);
    }
};

TEST_F(ShadingOptions, changeThePictureAndAreKeptInIt)
{
    const std::vector<float> path = picture({});
    EXPECT_EQ(attribute("sahl.integrator"), "path");
    EXPECT_EQ(attribute("sahl.normals"), "interpolated");
    EXPECT_EQ(attribute("sahl.terms"), "(none)");
    EXPECT_NE(picture({"--normals", "flat"}), path);
    EXPECT_EQ(attribute("sahl.normals"), "flat");

    const Arguments phong = {"--integrator", "phong", "--terms"};
    auto with = [&](std::initializer_list<const char*> more) {
        Arguments arguments = phong;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return picture(arguments);
    };
    const std::vector<float> all = with({"specular,ambient,diffuse", "--shadows", "on"});
    EXPECT_EQ(attribute("sahl.integrator"), "phong");
    EXPECT_EQ(attribute("sahl.terms"), "ambient,diffuse,specular");
    EXPECT_EQ(attribute("sahl.shadows"), "on");
    const std::vector<float> ambient = with({"ambient"}), diffuse = with({"diffuse"});
    EXPECT_EQ(attribute("sahl.terms"), "diffuse");
    EXPECT_EQ(attribute("sahl.shadows"), "off");
    const std::vector<float> specular = with({"specular"});
    ASSERT_EQ(all.size(), ambient.size());
    for (size_t i = 0; i < all.size(); i++) {
        // Where nothing is seen, all pictures show the studio.
        if (ambient[i] == diffuse[i]) continue;
        EXPECT_FLOAT_EQ(all[i], ambient[i] + diffuse[i] + specular[i]);
    }
    EXPECT_NE(all, diffuse);
}

TEST_F(ShadingOptions, ofNoMeaningAreRefused)
{
    const std::pair<Arguments, const char*> cases[] = {
        {{"--integrator", "fong"}, "--integrator 'fong' is not known; did you mean phong?"},
        {{"--terms", "ambient,difuse"}, "--terms 'difuse' is not known; did you mean diffuse?"},
        {{"--terms", ""}, "--terms '' is not known; choose ambient, diffuse or specular"},
        {{"--terms", "ambient,"}, "--terms '' is not known"},
        {{"--terms", "ambient,ambient"}, "--terms has 'ambient' twice"},
        {{"--shadows", "yes"}, "--shadows 'yes' is not known; choose off or on"},
        {{"--normals", "smooth"}, "--normals 'smooth' is not known; choose interpolated or flat"}};
    for (const auto& [arguments, words] : cases) expectRefused(render(arguments), 2, words);
}

}  // namespace
}  // namespace sahl::testing
