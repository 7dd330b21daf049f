// sahl bench start: from nothing to the samples of the first tile, as processes of their own.

#include "app/bench/bench.h"
#include "app/bench/rounds.h"
#include "app/bench/run_self.h"
#include "app/bench/scenes.h"
#include "app/bench/table.h"
#include "util/interrupt.h"
#include "util/messages.h"

#include <unistd.h>

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t ROUNDS = 5;

using Environment = std::vector<std::pair<std::string, std::string>>;

/// A folder that goes away with this object.
class ScratchFolder {
public:
    ScratchFolder() : path(fs::temp_directory_path() / fmt::format("sahl-bench-{}", getpid()))
    {
        fs::create_directories(path);
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const fs::path path;
};

void writeObj(const Mesh& mesh, const fs::path& path)
{
    std::string text;
    for (const vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const MeshTriangle& triangle : mesh.triangles) {
        const auto& [a, b, c] = triangle.position;
        text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    writeFileAtomically(path, text);
}

/// How Mesa's drivers are told to keep compiled kernels in a folder, or not at all.
Environment withCache(const fs::path& folder)
{
    return {{"MESA_SHADER_CACHE_DISABLE", "false"},
            {"MESA_SHADER_CACHE_DIR", folder.string()},
            {"XDG_CACHE_HOME", folder.string()}};
}
/// Nor can Sahl keep what it makes of kernels where no folder can be.
const Environment WITHOUT_CACHE = {{"MESA_SHADER_CACHE_DISABLE", "true"}, {"XDG_CACHE_HOME", "/dev/null"}};

}  // namespace

Json benchStart(const BenchOptions& options)
{
    const uint32_t rounds = options.repeat > 0 ? options.repeat : ROUNDS;
    const ScratchFolder scratch;
    std::vector<std::string> scenes = options.scenes;
    if (scenes.empty()) {
        const fs::path mesh = scratch.path / "torus.obj";
        writeObj(makeWavyTorus(options.triangles > 0 ? options.triangles : 70'000), mesh);
        scenes.push_back(mesh.string());
    }

    Json rows = Json::array();
    std::vector<TableRow> table;
    for (const std::string& scene : scenes) {
        const fs::path statistics = scratch.path / "stats.json";
        const std::string size = std::to_string(options.size);
        const std::vector<std::string> render = {
            "render", scene, "--spp", "1", "--width", size, "--height", size, "--max-bounces", "6",
            "--device", options.common.device, "--threads", std::to_string(threadsFor(options.common)),
            "-o", (scratch.path / "picture.pfm").string(), "--stats", statistics.string(), "-q"};
        Timing load = {"load and tree", {}};
        auto run = [&](const Environment& environment) {
            const double seconds = runSelf(render, environment);
            const Json found = Json::parse(readTextFile(statistics)).at("seconds");
            load.seconds.push_back(found.at("load").get<double>() + found.at("build").get<double>());
            // Without what follows the first tile
            return seconds - (found.at("total").get<double>() - found.at("firstSample").get<double>());
        };
        const Environment cached = withCache(scratch.path / "cache");
        run(cached);  // fills it
        const std::vector<Timing> timings = runRounds({{"empty", [&] { return runSelf({"devices"}, cached); }},
                                                       {"cold", [&] { return run(WITHOUT_CACHE); }},
                                                       {"warm", [&] { return run(cached); }}},
                                                      rounds);
        if (interruptSignal() != 0) break;
        const double empty = timings[0].median(), cold = timings[1].median(), warm = timings[2].median();
        const double compile = cold - warm;
        const double coldRatio = compile > 0 ? (cold - empty) / compile : 0;
        const double warmRatio = (warm - empty) / load.median();
        const std::string name = fs::path(scene).stem().string();
        rows.push_back({{"scene", name},
                        {"emptySeconds", timings[0].seconds},
                        {"coldSeconds", timings[1].seconds},
                        {"warmSeconds", timings[2].seconds},
                        {"loadSeconds", load.median()},
                        {"compileSeconds", compile},
                        {"coldToCompile", coldRatio},
                        {"warmToLoad", warmRatio}});
        table.push_back({name, shortNumber(empty), shortNumber(cold), shortNumber(warm), shortNumber(load.median()),
                         shortNumber(compile), shortNumber(coldRatio), shortNumber(warmRatio)});
    }
    answer("processes from start to the samples of the first tile, {} x {} pixels, medians of {} rounds [s]\n", options.size,
           options.size, rounds);
    printTable({"scene", "empty", "cold", "warm", "load, tree", "compile", "cold / compile", "warm / load"}, table);
    return {{"rounds", rounds}, {"size", options.size}, {"rows", rows}};
}

}  // namespace sahl
