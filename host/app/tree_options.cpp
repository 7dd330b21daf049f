#include "app/tree_options.h"

#include "app/option_kinds.h"

namespace sahl {

void addTreeOptions(CLI::App& command, CommonOptions& options)
{
    addChoice(command, "--bvh-build", options.bvhBuild,
              {{"auto", BvhBuild::automatic}, {"sweep", BvhBuild::sweep}, {"binned", BvhBuild::binned}},
              "auto, sweep (good tree) or binned (fast)")
        ->group("Scene");
    auto setQuality = [&options](const std::string& word) {
        const std::vector<std::string> words = {"standard", "high"};
        if (parseChoice("--bvh-quality", word, words) == 0) return;
        if (options.bvhBuild != BvhBuild::automatic)
            throw CLI::ValidationError("--bvh-quality high chooses how to build by itself; leave --bvh-build out");
        options.bvhBuild = BvhBuild::high;
    };
    command
        .add_option_function<std::string>("--bvh-quality", setQuality,
                                          withDefault("standard, or high: a better tree that takes a few times\n"
                                                      "as long, for long renders",
                                                      "standard"))
        ->type_name("NAME")
        ->group("Scene");
}

}  // namespace sahl
