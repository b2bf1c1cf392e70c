// Texts that programs write for JSON and that are none by its rules.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::inventory {

/// Returns whether a text begins as JSON, or as JSON in the words of a script: "var lamps = [",
/// "callback({".
bool begins_as_loose_json(std::string_view start);

/// Returns such a text as JSON: without the words of a script around it and comments, with null for
/// NaN and Infinity, numbers of more digits than 64 bits have as texts, no comma behind the last of
/// a list, and objects that follow each other without commas as a list. What else is wrong stays.
std::string straighten_json(std::string_view text);

}  // namespace nightcity::inventory
