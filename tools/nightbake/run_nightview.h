// nightview as a program of its own: it renders what bakes are compared by. Vulkan stays out of
// nightbake.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::nightbake {

/// Returns the program beside this one, or its name where PATH is to be searched.
std::filesystem::path find_nightview();

/// Runs a command that prints JSON, and returns that; nothing where there is no such program. Its
/// messages go to stderr. Throws Error where the command fails or prints no JSON.
std::optional<nlohmann::json> run_nightview(const std::filesystem::path& program,
                                            const std::vector<std::string>& arguments);

}  // namespace nightcity::nightbake
