// A look at TOML before it is parsed.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace nightcity::program {

/// Returns the line (from 1) of the first key in `text` that has more than `max_parts` parts joined
/// by dots ("a.b.c" has three), or nothing. Each part is a table within another: toml++ 3.3 limits
/// the nesting of brackets, but not that of dotted keys, and 100,000 parts exhaust the stack.
/// Strings and comments are skipped as TOML 1.0 delimits them.
std::optional<std::size_t> find_deep_key(std::string_view text, std::size_t max_parts);

}  // namespace nightcity::program
