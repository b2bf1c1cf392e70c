// TOML files that a program reads: recipes and settings.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace nightcity::program {

/// Returns the document. Throws Error with file and line where the text is not TOML, holds a zero
/// byte, or has keys so deep that they would exhaust the stack.
toml::table read_toml(const std::filesystem::path& path);

/// Throws UsageError with file and line: "unknown WHAT", with the nearest of `known` where one is
/// near.
[[noreturn]] void refuse_unknown_key(const std::string& file, const toml::key& key,
                                     const std::string& what,
                                     const std::vector<std::string>& known);

/// Returns the text as TOML's basic string (https://toml.io/en/v1.0.0#string), for values and keys:
/// toml++ 3.3 writes some texts that hold quotes so that they are no TOML.
std::string quote_for_toml(const std::string& text);

}  // namespace nightcity::program
