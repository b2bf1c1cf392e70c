// The option that names a command's output, and the check of it before any work.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace nightcity::program {

/// Adds the option that names a command's output, spelled alike in every command. `target` is a
/// string, a path or, where the option may be repeated, a vector of these. Returns the option, for
/// `->required()`.
template <typename Target>
CLI::Option* add_output_option(CLI::App& command, Target& target, const std::string& help) {
  return command.add_option("-o,--out,--output", target, help);
}

/// Creates `folder` with its parents unless it exists. Throws Error when that fails or nothing can
/// be written into it: a long computation should not find this out at its end. Folders made here
/// are removed, if they are empty, when this throws, when a signal ends the program, and by
/// remove_made_folders().
void require_writable_folder(const std::filesystem::path& folder);

/// Does the same for the folder that `file` will lie in, and throws Error where `file` is a folder.
void require_writable_folder_of(const std::filesystem::path& file);

/// Removes the folders made by require_writable_folder() that are empty: a command that fails
/// leaves nothing behind.
void remove_made_folders();
/// Keeps them for good: the command has succeeded.
void keep_made_folders();

}  // namespace nightcity::program
