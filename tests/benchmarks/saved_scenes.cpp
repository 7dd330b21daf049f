// How long a saved scene takes to load, against reading the same file into memory and hashing it:
//   sahl_bench_saved SCENE ... [--benchmark_...]
// The two are timed in turns, in time of the processor, so that other programs do not count; `ratio` is
// the one over the other. Files lie in the page cache.

#include "saved/container.h"
#include "saved/saved_scene.h"

#include <benchmark/benchmark.h>

#include <fstream>
#include <functional>

#include <time.h>

namespace sahl {
namespace {

/// [s] of this thread on the processor, the kernel's work for it included.
double secondsNow()
{
    timespec time = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

double secondsOf(const std::function<void()>& action)
{
    const double start = secondsNow();
    action();
    return secondsNow() - start;
}

void loadSavedFile(benchmark::State& state, const fs::path& path)
{
    std::vector<char> buffer(fs::file_size(path));
    const auto readAndHash = [&] {
        std::ifstream file(path, std::ios::binary);
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        benchmark::DoNotOptimize(hashOf(std::as_bytes(std::span(buffer))));
    };
    readAndHash();
    double loading = 0, reading = 0;
    for (auto _ : state) {
        reading += secondsOf(readAndHash);
        const double seconds =
            secondsOf([&] { benchmark::DoNotOptimize(loadSavedScene(path, {}).bvh.rootRef); });
        state.SetIterationTime(seconds);
        loading += seconds;
    }
    state.counters["ratio"] = loading / reading;
    state.counters["readMs"] = reading / double(state.iterations()) * 1e3;
    state.counters["MiB"] = double(buffer.size()) / double(1 << 20);
}

/// Saves the scene to a temporary file and plans its benchmark.
fs::path addScene(const fs::path& scene)
{
    const fs::path path =
        fs::temp_directory_path() / fmt::format("sahl-bench-{}.sahl", scene.stem().string());
    SceneOptions options;
    options.allowedPaths = {"/"};
    writeSavedScene(prepareScene(loadScene(scene, options), BvhBuild::automatic, 2), path);
    benchmark::RegisterBenchmark(("load/" + scene.stem().string()).c_str(),
                                 [path](benchmark::State& state) { loadSavedFile(state, path); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
    return path;
}

int run(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    if (argc < 2) {
        fmt::print(stderr, "usage: {} SCENE ... [--benchmark_...]\n", argv[0]);
        return 2;
    }
    std::vector<fs::path> files;
    for (int i = 1; i < argc; i++) files.push_back(addScene(argv[i]));
    benchmark::RunSpecifiedBenchmarks();
    for (const fs::path& path : files) fs::remove(path);
    return 0;
}

}  // namespace
}  // namespace sahl

int main(int argc, char** argv)
{
    try {
        return sahl::run(argc, argv);
    } catch (const sahl::Error& error) {
        fmt::print(stderr, "sahl_bench_saved: {}\n", error.what());
        return static_cast<int>(error.kind);
    }
}
