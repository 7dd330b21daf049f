// sahl bench: what the benchmarks share. Each is a function in a file of its own.
#pragma once

#include "app/options.h"

#include <nlohmann/json.hpp>

namespace sahl {

struct BenchOptions {
    CommonOptions common;
    std::string benchmark;
    std::vector<std::string> scenes;  ///< meshes or scene files; none: those that are generated
    std::string assets;
    std::string jsonPath;
    std::string plotPath;
    uint32_t size = 512;
    uint32_t repeat = 0;     ///< 0: 3 for the report's, else 5
    uint32_t spp = 16;
    uint32_t triangles = 0;  ///< of a generated scene; of scale the most; 0: the benchmark's own
    bool alone = false;      ///< the device, without the CPU and Embree beside it
};

/// Each prints its table and returns what is saved as JSON: keys are in docs/bench.md. They return early,
/// with what there is, once a signal has arrived.
nlohmann::ordered_json benchReport(const BenchOptions& options);
nlohmann::ordered_json benchTraversal(const BenchOptions& options);
nlohmann::ordered_json benchRender(const BenchOptions& options);
nlohmann::ordered_json benchBuild(const BenchOptions& options);
nlohmann::ordered_json benchStart(const BenchOptions& options);
nlohmann::ordered_json benchScale(const BenchOptions& options);
nlohmann::ordered_json benchCeiling(const BenchOptions& options);

}  // namespace sahl
