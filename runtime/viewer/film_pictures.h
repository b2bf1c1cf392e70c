// The pictures of a film: their number and their names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace nightcity::viewer {

/// Returns the number of pictures of a film, at least 1.
std::uint32_t count_pictures(double duration_s, double pictures_per_s);

/// Returns the name of a picture, which counts from 0: "frame-00012.png".
std::string name_of_picture(std::uint32_t number, const char* extension);

/// Returns how many pictures lie in a folder from `first` on before one is missing.
std::uint32_t count_present(const std::filesystem::path& folder, std::uint32_t first,
                            std::uint32_t pictures);

}  // namespace nightcity::viewer
