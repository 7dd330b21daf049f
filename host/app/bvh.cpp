// sahl bvh: what a scene's tree looks like, and scenes saved together with it.

#include "bvh/bvh.h"
#include "app/commands.h"
#include "app/option_kinds.h"
#include "app/options.h"
#include "app/outputs.h"
#include "app/stats.h"
#include "saved/saved_scene.h"
#include "util/error.h"
#include "util/messages.h"

#include <memory>

namespace sahl {

namespace {

struct BvhOptions {
    CommonOptions common;
    std::string savedPath;  ///< .sahl
    std::string jsonPath;
    std::string statsPath;
};

/// Bytes of each array of a scene.
struct SceneBytes {
    uint64_t nodes = 0, primitives = 0, normals = 0, texels = 0, rest = 0;
    uint64_t total() const { return nodes + primitives + normals + texels + rest; }
};

SceneBytes bytesOf(const DeviceScene& scene)
{
    return {scene.nodes.size_bytes(), scene.primitives.size_bytes(),
            scene.triangleCorners.size_bytes(),
            scene.probeTexels.size_bytes() + scene.textureTexels.size_bytes(),
            scene.materials.size_bytes() + scene.lights.size_bytes() +
                scene.instances.size_bytes() + scene.textures.size_bytes()};
}

double mebibytes(uint64_t bytes)
{
    return double(bytes) / double(1 << 20);
}

/// Refuses outputs that cannot be written, before anything is read. Returns all of them.
std::vector<fs::path> checkOutputs(const BvhOptions& options)
{
    auto requireExtension = [](const fs::path& path, const char* extension) {
        if (path.empty() || path.extension() == extension) return;
        throw usageError("output '{}': the name must end in {}", path.string(), extension);
    };
    requireExtension(options.savedPath, ".sahl");
    requireExtension(options.jsonPath, ".json");
    std::vector<fs::path> outputs;
    for (const std::string& path : {options.savedPath, options.jsonPath, options.statsPath}) {
        if (path.empty()) continue;
        if (std::find(outputs.begin(), outputs.end(), path) != outputs.end()) {
            throw usageError("{}: is written twice; name different files", path);
        }
        requireWritable(path);
        outputs.emplace_back(path);
    }
    return outputs;
}

nlohmann::ordered_json bvhJson(const PreparedScene& prepared, const StageSeconds& seconds)
{
    const DeviceScene scene = prepared.deviceScene();
    const SceneBytes bytes = bytesOf(scene);
    return {{"version", 1},
            {"scene",
             {{"name", prepared.scene.name},
              {"primitives", scene.primitives.size()},
              {"droppedTriangles", prepared.scene.droppedTriangles},
              {"materials", scene.materials.size()},
              {"lights", scene.frame.lightCount}}},
            {"tree", treeJson(prepared.bvh.statistics)},
            {"bytes",
             {{"nodes", bytes.nodes},
              {"primitives", bytes.primitives},
              {"normals", bytes.normals},
              {"texels", bytes.texels},
              {"total", bytes.total()}}},
            {"seconds",
             {{"load", seconds.load},
              {"build", seconds.build},
              {"write", seconds.write},
              {"total", seconds.total}}},
            {"peakMemoryBytes", peakMemory()}};
}

void printTree(const PreparedScene& prepared, const StageSeconds& seconds)
{
    const DeviceScene scene = prepared.deviceScene();
    const BvhStatistics& tree = prepared.bvh.statistics;
    const SceneBytes bytes = bytesOf(scene);
    answer("scene      {}, {} primitives, {} materials, {} lights\n", prepared.scene.name,
           scene.primitives.size(), scene.materials.size(), scene.frame.lightCount);
    answer("tree       {} inner nodes, {} leaves, depth {}, at most {} primitives a leaf\n",
           tree.innerNodes, tree.leaves, tree.depth, tree.largestLeaf);
    answer("SAH cost   {:.3f} tests a ray, built by {}\n", tree.sahCost,
           tree.build == BvhBuild::binned ? "bins" : tree.build == BvhBuild::high ? "reinsertion" : "sweep");
    answer("seconds    {:.3f} loading, {:.3f} building, {:.3f} writing\n", seconds.load,
           seconds.build, seconds.write);
    answer("memory     {:.2f} MiB: nodes {:.2f}, primitives {:.2f}, normals {:.2f}, probe {:.2f}; "
           "the program at most {:.2f}\n",
           mebibytes(bytes.total()), mebibytes(bytes.nodes), mebibytes(bytes.primitives),
           mebibytes(bytes.normals), mebibytes(bytes.texels), mebibytes(peakMemory()));
}

int runBvh(const BvhOptions& options)
{
    setQuiet(options.common.quiet);
    const std::vector<fs::path> outputs = checkOutputs(options);
    Stopwatch watch;
    StageSeconds seconds;
    const PreparedScene prepared = prepareSceneFor(options.common, [&](const Scene&) {
        refuseToReplaceInputs(outputs);
        seconds.load = watch.lap();
    });
    seconds.build = watch.lap();
    if (!options.savedPath.empty()) writeSavedScene(prepared, options.savedPath);
    if (!options.jsonPath.empty()) writeTreeJson(prepared, options.jsonPath);
    seconds.write = watch.lap();
    seconds.total = watch.total();
    if (!options.statsPath.empty()) {
        writeFileAtomically(options.statsPath, bvhJson(prepared, seconds).dump(2) + "\n");
    }
    if (options.common.quiet) return 0;
    printTree(prepared, seconds);
    for (const fs::path& path : outputs) answer("wrote      {}\n", path.string());
    return 0;
}

void addOutputOptions(CLI::App& command, BvhOptions& options)
{
    command
        .add_option("-o,--output", options.savedPath,
                    withDefault("scene and tree as one file to render from: .sahl", "none"))
        ->type_name("FILE")
        ->group("Output");
    command
        .add_option(
            "--json", options.jsonPath,
            withDefault("the same as nested JSON, instances included, to read and to render from",
                        "none"))
        ->type_name("FILE")
        ->group("Output");
    command
        .add_option("--stats", options.statsPath,
                    withDefault("write statistics as JSON (docs/stats.md)", "none"))
        ->type_name("FILE")
        ->group("Output");
}

}  // namespace

Command addBvhCommand(CLI::App& app)
{
    auto options = std::make_shared<BvhOptions>();
    CLI::App* command = app.add_subcommand("bvh", "build a scene's tree, tell about it, save both")
                            ->group("Commands");
    command
        ->add_option("scene", options->common.scenePath,
                     "scene (.json), mesh (.obj) or saved scene (.sahl)")
        ->required()
        ->type_name("SCENE");
    addOutputOptions(*command, *options);
    addSceneOptions(*command, options->common);
    addNumber(*command, "--threads", options->common.deviceOptions.threads, {1, 1024},
              "threads that build", "all cores")
        ->group("Scene");
    addFlag(*command, "-q,--quiet", options->common.quiet, "only errors")->group("Messages");
    command->footer(
        "A saved scene renders to the same bits as the scene that it was saved from, without\n"
        "building its tree again (docs/saved_scenes.md).\n\n"
        "Examples:\n"
        "  sahl bvh bunny.obj\n"
        "  sahl bvh bunny.obj -o bunny.sahl && sahl render bunny.sahl --spp 16 -o bunny.png\n"
        "  sahl bvh bunny.sahl --json tree.json");
    return [options] { return runBvh(*options); };
}

}  // namespace sahl
