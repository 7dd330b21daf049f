// Build step for shaders: `lint FILE...`, `exact IN.spv OUT.spv`, `embed OUT.cpp FUNCTION NAME=FILE.spv...`.

#include "lint.h"
#include "spirv_step.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>

namespace {

std::string readText(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<uint32_t> readModule(const std::string& path)
{
    std::string bytes = readText(path);
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

int lint(const std::vector<std::string>& files)
{
    int findings = 0;
    for (const auto& file : files) {
        for (const auto& finding : sahl::shader_step::lintText(file, readText(file))) {
            std::cerr << finding << "\n";
            findings++;
        }
    }
    return findings == 0 ? 0 : 1;
}

int makeExact(const std::string& input, const std::string& output)
{
    std::vector<uint32_t> module = readModule(input);
    auto refused = sahl::shader_step::refusedInstructions(module);
    for (const auto& line : refused) {
        std::cerr << input << ": not the same on every device: " << line << "\n";
    }
    if (!refused.empty()) return 1;
    module = sahl::shader_step::decoratedNoContraction(module);
    std::ofstream file(output, std::ios::binary);
    file.write(reinterpret_cast<const char*>(module.data()), static_cast<std::streamsize>(module.size() * 4));
    return file.good() ? 0 : 1;
}

/// Writes a C++ file that defines sahl::FUNCTION(name), which gives the words of the module so named.
int embed(const std::string& output, const std::string& function, const std::vector<std::string>& modules)
{
    std::ofstream file(output);
    file << "#include <cstdint>\n#include <span>\n#include <stdexcept>\n#include <string>\n\nnamespace sahl {\n\n"
         << "std::span<const uint32_t> " << function << "(std::string_view name);\n\nnamespace {\n";
    std::string chooser;
    for (const auto& entry : modules) {
        size_t equals = entry.find('=');
        std::string name = entry.substr(0, equals);
        file << "constexpr uint32_t " << name << "[] = {";
        size_t column = 0;
        for (uint32_t word : readModule(entry.substr(equals + 1))) {
            file << (column++ % 12 == 0 ? "\n    " : " ") << fmt::format("{:#x}u,", word);
        }
        file << "\n};\n";
        chooser += fmt::format("    if (name == \"{0}\") return {0};\n", name);
    }
    file << "}  // namespace\n\nstd::span<const uint32_t> " << function << "(std::string_view name)\n{\n"
         << chooser << "    throw std::logic_error(\"no kernel \" + std::string(name));\n}\n\n}  // namespace sahl\n";
    return file.good() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        std::vector<std::string> arguments(argv + 1, argv + argc);
        if (arguments.size() >= 2) {
            std::string verb = arguments[0];
            std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
            if (verb == "lint") return lint(rest);
            if (verb == "exact" && rest.size() == 2) return makeExact(rest[0], rest[1]);
            if (verb == "embed" && rest.size() >= 2) return embed(rest[0], rest[1], {rest.begin() + 2, rest.end()});
        }
        std::cerr << "usage: shader_step lint FILE... | exact IN OUT | embed OUT.cpp FUNCTION NAME=FILE...\n";
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "shader_step: " << error.what() << "\n";
        return 1;
    }
}
