// Reads JSON from strangers.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace nightcity {

/// Arrays and objects may lie in each other this deep. The library reads any depth, but copies,
/// compares and writes values by recursion, which some ten thousand levels end by a signal.
constexpr std::size_t max_json_depth = 256;

/// Returns the document in `text` (RFC 8259). Throws Error about `name` where it is no JSON, or
/// deeper than max_json_depth.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// Returns what an error of the library says, without its own name for it.
std::string describe(const nlohmann::json::exception& error);

/// Does as parse_json, but without an error: the value is discarded (is_discarded()) then.
nlohmann::json try_parse_json(std::string_view text);

}  // namespace nightcity
