#include "app/shading_options.h"

#include "app/option_kinds.h"
#include "scene/phong.h"

#include <algorithm>

namespace sahl {

namespace {

/// "ambient,diffuse" as bits; each term once.
uint32_t parseTerms(const std::string& text)
{
    std::vector<std::string> names;
    for (const PhongTerm& term : phongTerms()) names.push_back(term.name);
    uint32_t bits = 0;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(',', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const uint32_t bit = phongTerms()[parseChoice("--terms", word, names)].bit;
        if ((bits & bit) != 0) {
            throw CLI::ValidationError(fmt::format("--terms has '{}' twice", word));
        }
        bits |= bit;
        begin = end + 1;
    }
    return bits;
}

/// --name NAME, where the first of two words means false and the second true.
void addSwitch(CLI::App& command, const std::string& name, std::optional<bool>& target,
               const std::vector<std::string>& words, const std::string& help,
               const std::string& standard)
{
    auto set = [&target, name, words](const std::string& text) {
        target = parseChoice(name, text, words) == 1;
    };
    command.add_option_function<std::string>(name, set, withDefault(help, standard))
        ->type_name("NAME")
        ->group("Picture");
}

}  // namespace

void addShadingOptions(CLI::App& command, SceneOptions& scene)
{
    auto setIntegrator = [&scene](const std::string& text) {
        const bool phong = parseChoice("--integrator", text, {"path", "phong"}) == 1;
        scene.integrator = phong ? INTEGRATOR_PHONG : INTEGRATOR_PATH;
    };
    command
        .add_option_function<std::string>("--integrator", setIntegrator,
                                          withDefault("path or phong", "the scene's, else path"))
        ->type_name("NAME")
        ->group("Picture");
    auto setTerms = [&scene](const std::string& text) { scene.terms = parseTerms(text); };
    command
        .add_option_function<std::string>(
            "--terms", setTerms,
            withDefault("of phong: ambient, diffuse, specular; commas between\nseveral",
                        "the scene's, else all"))
        ->type_name("NAMES")
        ->group("Picture");
    addSwitch(command, "--shadows", scene.shadows, {"off", "on"},
              "of phong: shadow rays, on or off", "the scene's, else off");
    addSwitch(command, "--normals", scene.flatNormals, {"interpolated", "flat"},
              "interpolated or flat", "the scene's, else interpolated");
}

std::string integratorName(const RenderSettings& settings)
{
    return settings.integrator == INTEGRATOR_PHONG ? "phong" : "path";
}

ImageMetadata describeShading(const RenderSettings& settings)
{
    const bool flat = (settings.shading & SHADING_FLAT) != 0;
    ImageMetadata entries = {{"sahl.normals", flat ? "flat" : "interpolated"}};
    if (settings.integrator != INTEGRATOR_PHONG) return entries;
    std::vector<std::string> terms;
    for (const PhongTerm& term : phongTerms()) {
        if ((settings.shading & term.bit) != 0) terms.push_back(term.name);
    }
    entries["sahl.terms"] = fmt::format("{}", fmt::join(terms, ","));
    entries["sahl.shadows"] = (settings.shading & SHADING_SHADOWS) != 0 ? "on" : "off";
    return entries;
}

}  // namespace sahl
