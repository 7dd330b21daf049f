#include "device/variants.h"

#include "device/driver_habits.h"
#include "util/cache_folder.h"
#include "util/error.h"
#include "util/files.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace sahl {

namespace {

// Lines of the file of what was tuned: device, driver and variant, with tabs between.
struct TunedLine {
    std::string device, driver, variant;
};

std::vector<TunedLine> tunedLines()
{
    std::vector<TunedLine> lines;
    std::ifstream file(tuningFile());
    for (TunedLine line; std::getline(file, line.device, '\t') &&
                         std::getline(file, line.driver, '\t') && std::getline(file, line.variant);)
        lines.push_back(line);
    return lines;
}

/// Tabs and line ends would tear the file apart.
std::string asWord(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n'; }, ' ');
    return text;
}

std::optional<Variant> findVariant(const std::string& name)
{
    for (const Variant& variant : allVariants())
        if (nameOf(variant) == name) return variant;
    return {};
}

}  // namespace

std::string nameOf(const Variant& variant)
{
    std::string name = variant.texelBuffers ? "texel" : "storage";
    if (variant.paths == Variant::Paths::whole)
        name += fmt::format("-{}x{}-by{}", variant.groupWidth, variant.groupHeight, variant.samplesAtOnce);
    else
        name += variant.paths == Variant::Paths::waves ? "-wave" : "-wave-shared";
    return name + (variant.stackInRegisters ? "-registers" : "") + (variant.stepByStep ? "-steps" : "");
}

std::vector<Variant> allVariants()
{
    std::vector<Variant> all;
    for (bool texel : {true, false}) {
        for (uint32_t width : {8u, 16u})
            for (uint32_t samples : {1u, BLOCK_SIZE})
                for (bool registers : {false, true})
                    all.push_back({texel, width, 8, samples, registers, false, Variant::Paths::whole});
        for (bool registers : {false, true}) {
            all.push_back({texel, 8, 8, BLOCK_SIZE, registers, true, Variant::Paths::whole});
            for (bool steps : {false, true})
                all.push_back({texel, 64, 1, BLOCK_SIZE, registers, steps, Variant::Paths::waves});
        }
        all.push_back({texel, 64, 1, BLOCK_SIZE, false, false, Variant::Paths::sharedWaves});
    }
    return all;
}

Variant variantNamed(const std::string& name)
{
    if (std::optional<Variant> found = findVariant(name)) return *found;
    std::string names;
    for (const Variant& variant : allVariants())
        names += (names.empty() ? "" : ", ") + nameOf(variant);
    throw usageError("--variant {}: no such variant; there are {}", name, names);
}

Variant standardVariant(const std::string& driver)
{
    // lavapipe 22.3: texel buffers 1.2 to 1.9 times as fast as storage buffers, shapes of
    // workgroups within 4 %, all samples of a block at once 1.3 times as fast
    // as one on short paths. SwiftShader has no texel buffers of any size.
    // The stack in registers: lavapipe 22.3 1.1 to 1.5 times as fast, 25.0 1.0 to 1.1;
    // SwiftShader and NVIDIA's H200 0.8; other drivers are not measured.
    const bool registers = driver.starts_with("llvmpipe");
    // Step by step: NVIDIA's H200 1.08 and 1.14 times as fast (diffuse rays), lavapipe 25.0 1.0 and 1.04; lavapipe 22.3
    // 0.8 and 1.0.
    const bool steps = driver.starts_with("NVIDIA ") || isNewLavapipe(driver);
    return {true, 8, 8, BLOCK_SIZE, registers, steps, Variant::Paths::whole};
}

std::string tuningFile()
{
    const fs::path folder = cacheFolder();
    return folder.empty() ? "" : (folder / "variants.tsv").string();
}

std::optional<Variant> tunedVariant(const std::string& device, const std::string& driver)
{
    for (const TunedLine& line : tunedLines())
        if (line.device == asWord(device) && line.driver == asWord(driver))
            return findVariant(line.variant);
    return {};
}

void keepTunedVariant(const std::string& device, const std::string& driver, const Variant& variant)
{
    const fs::path path = tuningFile();
    if (path.empty())
        throw Error(ErrorKind::cannotWrite,
                    "nowhere to keep what was tuned: neither XDG_CACHE_HOME nor HOME is set");
    std::string text;
    for (const TunedLine& line : tunedLines())
        if (line.device != asWord(device) || line.driver != asWord(driver))
            text += fmt::format("{}\t{}\t{}\n", line.device, line.driver, line.variant);
    text += fmt::format("{}\t{}\t{}\n", asWord(device), asWord(driver), nameOf(variant));
    std::error_code failed;
    fs::create_directories(path.parent_path(),
                           failed);  // what fails here fails below, with the path
    writeFileAtomically(path, text);
}

}  // namespace sahl
