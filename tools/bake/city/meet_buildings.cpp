#include "tools/bake/city/meet_buildings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "formats/median.h"

namespace nightcity::bake {
namespace {

constexpr std::size_t max_feet = 20'000;

// Returns some of the feet, in an order in which those that lie together follow each other.
std::vector<glm::dvec3> choose(const std::vector<glm::dvec3>& feet) {
  const std::size_t stride = std::max<std::size_t>(1, feet.size() / max_feet);
  std::vector<glm::dvec3> some;
  for (std::size_t i = 0; i < feet.size(); i += stride) some.push_back(feet[i]);
  std::sort(some.begin(), some.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::make_pair(std::floor(a.x / 500), a.y) < std::make_pair(std::floor(b.x / 500), b.y);
  });
  return some;
}

// Returns how far each foot is above the heights, where there is one.
template <class HeightsAt>
std::vector<double> find_differences(std::span<const glm::dvec3> feet, const HeightsAt& at) {
  constexpr std::size_t together = 500;  // places that lie together are read together
  std::vector<double> differences;
  for (std::size_t begin = 0; begin < feet.size(); begin += together) {
    const auto some = feet.subspan(begin, std::min(together, feet.size() - begin));
    const std::vector<glm::dvec2> places(some.begin(), some.end());
    const std::vector<double> heights = at(places);
    for (std::size_t i = 0; i < heights.size(); ++i)
      if (std::isfinite(heights[i])) differences.push_back(some[i].z - heights[i]);
  }
  return differences;
}

// Returns what is to be doubted, behind "; ".
std::string doubt(const std::vector<double>& differences, double largest_shift_m) {
  constexpr double far_m = 5, many_percent = 10;
  // The geoid lies within 107 m of the ellipsoid, and national datums within metres of it.
  constexpr double any_datum_m = 120;
  const auto far = std::count_if(differences.begin(), differences.end(),
                                 [](double difference) { return std::abs(difference) > far_m; });
  const double percent = 100.0 * static_cast<double>(far) /
                         static_cast<double>(std::max<std::size_t>(differences.size(), 1));
  std::string text;
  if (largest_shift_m > any_datum_m)
    text += "; no datum explains so much: are its heights, or the model's, in another unit?";
  if (percent > many_percent)
    text += fmt::format(
        "; {:.0f} % of their feet are still more than {:.0f} m off: a surface model (with roofs) "
        "in "
        "place of a terrain model, or heights of several datums or another unit?",
        percent, far_m);
  return text;
}

}  // namespace

// Elevation models and city models differ in what their heights count from (geoid, ellipsoid, a
// national datum) and by the model's own error. The median over the buildings' footprints removes
// both.
std::string meet_buildings(GroundHeights& heights, const std::vector<glm::dvec3>& feet) {
  const std::vector<glm::dvec3> some = choose(feet);
  std::vector<std::optional<double>> shifts;
  for (std::size_t kind = 0; kind < heights.kinds().size(); ++kind) {
    std::vector<double> differences = find_differences(
        some, [&](const std::vector<glm::dvec2>& places) { return heights.at(places, kind); });
    shifts.push_back(differences.empty() ? std::optional<double>()
                                         : median(std::move(differences)));
  }
  const auto first = std::find_if(shifts.begin(), shifts.end(),
                                  [](const auto& shift) { return shift.has_value(); });
  const double usual = first == shifts.end() ? 0 : **first;
  std::string text;
  double largest = 0;
  for (std::size_t kind = 0; kind < shifts.size(); ++kind) {
    const double shift_m = shifts[kind].value_or(usual);
    heights.move(kind, shift_m);
    largest = std::max(largest, std::abs(shift_m));
    text += text.empty() ? fmt::format("moved by {:+.2f} m", shift_m)
                         : fmt::format(" (those every {:.3g} m by {:+.2f} m)",
                                       heights.kinds()[kind].step_m, shift_m);
  }
  const std::vector<double> rest = find_differences(
      some, [&](const std::vector<glm::dvec2>& places) { return heights.at(places); });
  return text + " to meet the buildings" + doubt(rest, largest);
}

}  // namespace nightcity::bake
