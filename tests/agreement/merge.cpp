// Parts of a picture that were rendered on different devices, written to files and merged: the film
// of one run on the CPU.
#include "film/merge.h"
#include "support/device_test.h"
#include "support/film_files.h"
#include "support/render_scenes.h"

#include <algorithm>

namespace sahl::testing {
namespace {

constexpr uint32_t SPP = 61;  // 8 blocks, the last with 5 samples

class MergedParts : public DeviceTest {
protected:
    static const PreparedScene& scene()
    {
        static const PreparedScene prepared =
            prepareScene(builtInScene(smallPicture(32, 24, SPP)), BvhBuild::sweep, 2);
        return prepared;
    }

    FilmFile filmFile(Device& device, const SampleRange& range) const
    {
        FilmFileParts parts;
        parts.film = renderFilm(device, scene(), range.first, range.end - range.first);
        parts.metadata["sahl.version"] = "1";
        parts.fromFilm({{range}, SPP});
        const fs::path path = folder_.path / std::to_string(range.first);
        writeFileAtomically(path, parts.encode());
        return openFilmFile(path);
    }

    TemporaryFolder folder_;
};

TEST_F(MergedParts, ofDeviceAndReference_areTheFilmOfOneRun)
{
    const auto cpu = makeCpuDevice({});
    const Film whole = renderFilm(*cpu, scene());
    const auto device = openFirstDevice();
    for (uint32_t count : {1u, 3u, 7u}) {
        std::vector<FilmFile> files;
        for (uint32_t i = 0; i < count; i++) {
            files.push_back(filmFile(i % 2 == 0 ? *device : *cpu, shardOf(i, count, SPP)));
        }
        EXPECT_TRUE(mergeFilms(files, false).film == whole) << count;
        std::reverse(files.begin(), files.end());
        EXPECT_TRUE(mergeFilms(files, false).film == whole) << count;
    }
}

}  // namespace
}  // namespace sahl::testing
