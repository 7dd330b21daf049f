#include "app/usage.h"

#include "app/option_kinds.h"
#include "util/error.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr size_t OPTION_COLUMN = 26;

std::vector<std::string> optionsOf(const CLI::App& command)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

std::vector<std::string> commandsOf(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
    std::string near = suggestion(word, known);
    return near.empty() ? "" : "; did you mean " + near + "?";
}

/// About the words that belong to nothing: the first that looks like an option, else the first.
std::string unexpected(const CLI::App& app, const std::vector<std::string>& words)
{
    const CLI::App& command = activeCommand(app);
    for (const std::string& word : words) {
        if (!word.starts_with('-')) continue;
        std::string name = word.substr(0, word.find('='));
        std::vector<std::string> known = optionsOf(command);
        if (std::find(known.begin(), known.end(), name) != known.end()) {
            return fmt::format("{} belongs after the command: sahl {} {} ...", name,
                               command.get_name(), name);
        }
        // -spp is meant as --spp
        std::string spelling = name.starts_with("--") || name.size() <= 2 ? name : "-" + name;
        return fmt::format("unknown option {}{}", name, didYouMean(spelling, known));
    }
    const std::string& word = words.front();
    if (&command == &app) {
        std::string hint = didYouMean(word, commandsOf(app));
        if (hint.empty()) hint = "; choose " + enumeration(commandsOf(app));
        return fmt::format("unknown command '{}'{}", word, hint);
    }
    return fmt::format("unexpected '{}' after 'sahl {}'", word, command.get_name());
}

/// What a command cannot do without.
const char* inputOf(const std::string& command)
{
    if (command == "tonemap") return "a picture: an .exr, .hdr or .pfm file";
    if (command == "compare") return "two pictures: .exr, .hdr, .pfm or .png files";
    if (command == "merge") return "parts of a picture: .exr files by sahl render --shard, and -o";
    return "a scene: a .json, .gltf, .glb, .obj or .ply file";
}

/// The option that a message of the library starts with ("--spp: 1 required ..."), or null.
const CLI::Option* optionNamedIn(const CLI::App& command, const std::string& message)
{
    std::string name = message.substr(0, message.find_first_of(": "));
    return command.get_option_no_throw(name.starts_with('-') ? name : "--" + name);
}

}  // namespace

const CLI::App& activeCommand(const CLI::App& app)
{
    auto chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error)
{
    const CLI::App& command = activeCommand(app);
    std::vector<std::string> unused = command.remaining(true);
    auto kind = static_cast<CLI::ExitCodes>(error.get_exit_code());
    if (kind == CLI::ExitCodes::ValidationError) return error.what();  // from option_kinds.h
    std::erase(unused, "--");
    std::string text = error.what();
    if (unused.empty() && kind == CLI::ExitCodes::ExtrasError) {
        unused.push_back(text.substr(text.rfind(' ') + 1));  // a word after "--"
    }
    if (!unused.empty()) return unexpected(app, unused);
    if (kind == CLI::ExitCodes::RequiredError && &command == &app) {
        return "a command is missing; choose " + enumeration(commandsOf(app));
    }
    if (kind == CLI::ExitCodes::RequiredError) {
        return fmt::format("'sahl {}' needs {}", command.get_name(), inputOf(command.get_name()));
    }
    const CLI::Option* option = optionNamedIn(command, error.what());
    if (option && option->get_items_expected_max() == 0)
        return option->get_name() + " takes no value";
    if (option)
        return fmt::format("{} needs a value: {}", option->get_name(), option->get_type_name());
    return error.what();
}

HelpFormatter::HelpFormatter()
{
    column_width(OPTION_COLUMN);
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const
{
    std::string words =
        app->get_parent() == nullptr ? fmt::format("{}", fmt::join(commandsOf(*app), "|")) : "";
    for (const CLI::Option* option : app->get_options()) {
        if (!option->get_positional()) continue;
        std::string type = option->get_type_name();
        words += (words.empty() ? "" : " ") + (option->get_required() ? type : "[" + type + "]");
    }
    return fmt::format("\nUsage: {} {}{}[options]\n", name, words, words.empty() ? "" : " ");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const
{
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, name, mode), "\n\n\n",
                                         "\n\n");
}

std::string HelpFormatter::make_option_name(const CLI::Option* option, bool positional) const
{
    return positional ? option->get_type_name() : option->get_name(false, true);
}

std::string HelpFormatter::make_description(const CLI::App* app) const
{
    return app->get_description() + "\n";
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const
{
    if (option->get_positional() || option->get_type_size() == 0) return "";
    return " " + option->get_type_name();
}

}  // namespace sahl
