// Manual pages, made from the same declarations as --help.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace nightcity::program {

struct Program;

/// Returns the manual page of a whole program, or of its subcommand `command`, for man(1): roff
/// text with the macros of man(7). It holds what --help prints: usage, description, every argument
/// and option with its help text, and the footer, whose lines from "Example" on become the section
/// EXAMPLES.
std::string to_man_page(const Program& program, const CLI::App& app);
std::string to_man_page(const Program& program, const CLI::App& app, const CLI::App& command);

/// Writes PROGRAM.1 and a PROGRAM-COMMAND.1 for each subcommand of `app` to `folder`, which is made
/// if needed.
void write_man_pages(const Program& program, const CLI::App& app,
                     const std::filesystem::path& folder);

}  // namespace nightcity::program
