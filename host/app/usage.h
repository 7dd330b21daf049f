// What the command line library says, in Sahl's words: errors of usage and the layout of --help.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace sahl {

/// What is wrong with the command line, in a sentence, and what would help.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error);

/// The subcommand that was chosen, or the program itself.
const CLI::App& activeCommand(const CLI::App& app);

/// Lays out --help: options in groups, a line each.
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter();
    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override;
    std::string make_usage(const CLI::App* app, std::string name) const override;
    std::string make_description(const CLI::App* app) const override;
    std::string make_option_name(const CLI::Option* option, bool positional) const override;
    std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace sahl
