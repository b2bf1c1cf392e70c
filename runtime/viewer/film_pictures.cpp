#include "runtime/viewer/film_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nightcity::viewer {

std::uint32_t count_pictures(double duration_s, double pictures_per_s) {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(duration_s * pictures_per_s)));
}

std::string name_of_picture(std::uint32_t number, const char* extension) {
  return fmt::format("frame-{:05}{}", number, extension);
}

std::uint32_t count_present(const std::filesystem::path& folder, std::uint32_t first,
                            std::uint32_t pictures) {
  std::uint32_t end = first;
  std::error_code ignored;
  while (end < pictures && std::filesystem::exists(folder / name_of_picture(end, ".png"), ignored))
    ++end;
  return end - first;
}

}  // namespace nightcity::viewer
