// Samplers, roulette and the clamp of indirect light: the same bits on the device and the
// reference, in one go and in parts.

#include "film/merge.h"
#include "support/adaptive_scenes.h"
#include "support/device_test.h"
#include "support/film_files.h"
#include "support/small_scenes.h"

namespace sahl::testing {
namespace {

constexpr uint32_t SPP = 20;  // the last block is not full

/// The built-in scene with a glass ball, under all of it at once.
const PreparedScene& scene()
{
    static const PreparedScene prepared = [] {
        Scene scene = builtInScene(smallPicture(28, 20, SPP));
        addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.5f);
        addSphere(scene, {0.2f, 0.5f, 1.8f}, 0.4f);
        scene.settings.samplerKind = SAMPLER_SOBOL;
        scene.settings.rouletteDepth = 1;
        scene.settings.clampIndirect = 0.5f;
        return prepareScene(std::move(scene), BvhBuild::sweep, 2);
    }();
    return prepared;
}

const Film& reference()
{
    static const Film film = renderFilm(*makeCpuDevice({}), scene());
    return film;
}

class SamplingBits : public DeviceTest {};

TEST_F(SamplingBits, areEqualOnTheDeviceAndTheReference)
{
    EXPECT_GT(reference().counters.clamped, 100u);
    EXPECT_TRUE(renderFilm(*openFirstDevice(), scene()) == reference());
}

TEST_F(SamplingBits, areEqualWhenPathsRunOutOfSteps)
{
    DeviceOptions options;
    options.stepBudget = 60;
    const auto device = openFirstDevice(options);
    EXPECT_TRUE(renderFilm(*device, scene()) == reference());
    EXPECT_GT(device->statistics().resumptions, 0u);
}

TEST_F(SamplingBits, areEqualForRulesThatLookAtBlocks)
{
    const auto cpu = makeCpuDevice({});
    const auto device = openFirstDevice();
    for (uint32_t rule : {ADAPTIVE_CROSSED, ADAPTIVE_JOINT}) {
        const AdaptiveRule adaptive = targetRule(rule, 0.1f, 32, 96);
        const RenderResult ours = renderAdaptiveFilm(*device, scene(), adaptive);
        const RenderResult theirs = renderAdaptiveFilm(*cpu, scene(), adaptive);
        EXPECT_TRUE(ours.film == theirs.film) << rule;
        EXPECT_EQ(ours.adaptive, theirs.adaptive);
        EXPECT_GT(theirs.adaptive.converged, 0u);
        EXPECT_GT(theirs.adaptive.atMaximum, 0u);
    }
}

TEST_F(SamplingBits, ofPartsOfDeviceAndReferenceAreThoseOfOneRun)
{
    const TemporaryFolder folder;
    const auto cpu = makeCpuDevice({});
    const auto device = openFirstDevice();
    std::vector<FilmFile> files;
    for (uint32_t i = 0; i < 3; i++) {
        const SampleRange range = shardOf(i, 3, SPP);
        FilmFileParts parts;
        parts.film =
            renderFilm(i == 1 ? *device : *cpu, scene(), range.first, range.end - range.first);
        parts.metadata = {{"sahl.version", "1"}, {"sahl.varianceOver", "blocks"}};
        parts.fromFilm({{range}, SPP});
        writeFileAtomically(folder.path / std::to_string(i), parts.encode());
        files.push_back(openFilmFile(folder.path / std::to_string(i)));
    }
    EXPECT_TRUE(mergeFilms(files, false).film == reference());
}

/// The same by blocks of 64; the last one is not full.
const PreparedScene& sceneBySobol64()
{
    static const PreparedScene prepared = [] {
        Scene scene = builtInScene(smallPicture(12, 9, 150));
        scene.settings.samplerKind = SAMPLER_SOBOL64;
        return prepareScene(std::move(scene), BvhBuild::sweep, 2);
    }();
    return prepared;
}

TEST_F(SamplingBits, bySobol64AreEqualOnTheDeviceAndTheReference_inOneGoAndInParts)
{
    const TemporaryFolder folder;
    const auto cpu = makeCpuDevice({});
    const auto device = openFirstDevice();
    const Film one = renderFilm(*cpu, sceneBySobol64());
    EXPECT_EQ(one.replicateSize, 64u);
    EXPECT_EQ(one.half[0][0].samples, 64u + 22u);
    EXPECT_TRUE(renderFilm(*device, sceneBySobol64()) == one);
    std::vector<FilmFile> files;
    for (uint32_t i = 0; i < 2; i++) {
        const SampleRange range = shardOf(i, 2, 150, 64);
        FilmFileParts parts;
        parts.film = renderFilm(i == 1 ? *device : *cpu, sceneBySobol64(), range.first, range.end - range.first);
        parts.metadata = {{"sahl.version", "1"}, {"sahl.varianceOver", "blocks of 64"}};
        parts.fromFilm({{range}, 150});
        writeFileAtomically(folder.path / std::to_string(i), parts.encode());
        files.push_back(openFilmFile(folder.path / std::to_string(i)));
    }
    EXPECT_TRUE(mergeFilms(files, false).film == one);
}

}  // namespace
}  // namespace sahl::testing
