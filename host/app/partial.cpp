#include "app/partial.h"

#include "app/option_kinds.h"
#include "util/error.h"

#include <utility>

namespace sahl {

void addPartialOption(CLI::App& command, std::optional<double>& seconds)
{
    auto set = [&seconds](const std::string& text) {
        seconds = parseReal("--partial", text, 0, 1e6);
    };
    command
        .add_option_function<std::string>(
            "--partial", set,
            withDefault("write the picture so far every so many seconds; 0: after\n"
                        "every pass of 8 samples",
                        "only at the end"))
        ->type_name("SECONDS")
        ->group("Output");
}

PartialPictures::PartialPictures(double seconds, std::function<void(const RenderResult&)> write)
    : seconds_(seconds), write_(std::move(write))
{
}

bool PartialPictures::isDue() const
{
    return std::chrono::duration<double>(Clock::now() - last_).count() >= seconds_;
}

void PartialPictures::passDone(const RenderResult& result)
{
    if (!isDue()) return;
    try {
        write_(result);
    } catch (const std::exception& failure) {
        if (!std::exchange(warned_, true)) {
            warn(fmt::format("{}; the picture so far could not be written; rendering goes on",
                             failure.what()));
        }
    }
    last_ = Clock::now();
}

}  // namespace sahl
