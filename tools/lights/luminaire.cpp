#include "tools/lights/luminaire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/archive_entries.h"
#include "tools/city/attributes.h"
#include "tools/city/foreign_format.h"
#include "tools/city/packing.h"
#include "tools/lights/text_lines.h"

namespace nightcity::lights {
namespace {

using std::numbers::pi;

constexpr double radians(double degrees) {
  return degrees * pi / 180;
}

/// Returns the greatest step of a regular grid over `whole` degrees that contains every angle; 0.5
/// if there is none.
double common_step(const std::vector<double>& angles, double offset, double whole) {
  const auto own = static_cast<double>(angles.size() - 1);
  for (const double step : {90.0, 45.0, 30.0, 22.5, 15.0, 10.0, 7.5, 5.0, 2.5, 2.0, 1.0, 0.5, 0.25,
                            0.2, 0.1, 0.05, own > 0 ? (angles.back() - angles.front()) / own : 0}) {
    if (step > whole || step < 0.02) continue;
    if (std::all_of(angles.begin(), angles.end(), [&](double angle) {
          const double steps = (angle - offset) / step;
          return std::abs(steps - std::round(steps)) < 1e-6;
        }))
      return step;
  }
  return 0.5;
}

/// Returns the light below the horizon in the four quarter turns round C = 0, 90, 180 and 270.
std::array<double, 4> quarters(const IntensityGrid& grid) {
  std::array<double, 4> flux{};
  for (int c = 0; c < 360; c += 3)
    for (int gamma = 1; gamma < 90; gamma += 2)
      flux[static_cast<std::size_t>((c + 45) / 90 % 4)] +=
          intensity_at(grid, c, gamma) * std::sin(radians(gamma));
  return flux;
}

/// Returns how much the light differs from its mirror image in the plane of `c`, as a share
/// of its sum.
double mirror_error(const IntensityGrid& grid, double c) {
  double difference = 0, sum = 0;
  for (int turn = 3; turn < 180; turn += 3)
    for (int gamma = 1; gamma < 90; gamma += 2) {
      const double left = intensity_at(grid, c + turn, gamma),
                   right = intensity_at(grid, c - turn, gamma);
      difference += std::abs(left - right) * std::sin(radians(gamma));
      sum += (left + right) * std::sin(radians(gamma));
    }
  return sum > 0 ? difference / sum : 0;
}

/// Calls `take` with each line of the text, without blanks around it, until it returns false.
void for_each_line(std::string_view text, const std::function<bool(std::string_view)>& take) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = city::trim(text.substr(0, end));
    text.remove_prefix(end);
    text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
    if (!take(line)) return;
  }
}

}  // namespace

double intensity_at(const IntensityGrid& grid, double c_degrees, double gamma_degrees) {
  const auto& gammas = grid.gamma_degrees;
  if (gamma_degrees < gammas.front() - 1e-9 || gamma_degrees > gammas.back() + 1e-9) return 0;
  const auto column = [&](std::size_t row, double gamma) {
    const double* values = grid.candela.data() + row * gammas.size();
    if (gammas.size() == 1) return values[0];
    const auto above = std::upper_bound(gammas.begin() + 1, gammas.end() - 1, gamma);
    const auto g = static_cast<std::size_t>(above - gammas.begin());
    const double t = std::clamp((gamma - gammas[g - 1]) / (gammas[g] - gammas[g - 1]), 0.0, 1.0);
    return values[g - 1] + t * (values[g] - values[g - 1]);
  };
  const auto& planes = grid.c_degrees;
  if (planes.size() == 1) return column(0, gamma_degrees);
  const double c = c_degrees - 360 * std::floor(c_degrees / 360);
  // planes[0] is 0, so there is always a plane at or before c. The first follows the last.
  const auto next = std::upper_bound(planes.begin(), planes.end(), c);
  const auto before = static_cast<std::size_t>(next - planes.begin()) - 1;
  const std::size_t after = next == planes.end() ? 0 : before + 1;
  const double end = next == planes.end() ? 360 : planes[after];
  const double t = (c - planes[before]) / (end - planes[before]);
  return (1 - t) * column(before, gamma_degrees) + t * column(after, gamma_degrees);
}

double integrated_flux(const IntensityGrid& grid) {
  const std::size_t count = grid.gamma_degrees.size(), planes = grid.c_degrees.size();
  double sum = 0;
  for (std::size_t row = 0; row < planes; ++row) {
    // Trapezoidal rule: a plane weighs half the angle to its neighbours on both sides.
    const double before = row == 0 ? grid.c_degrees.back() - 360 : grid.c_degrees[row - 1];
    const double after = row + 1 == planes ? grid.c_degrees.front() + 360 : grid.c_degrees[row + 1];
    const double weight = radians(after - before) / 2;
    for (std::size_t g = 0; g + 1 < count; ++g) {
      const double a = radians(grid.gamma_degrees[g]), b = radians(grid.gamma_degrees[g + 1]);
      const double fa = grid.candela[row * count + g], fb = grid.candela[row * count + g + 1];
      sum += weight * (fa * std::cos(a) - fb * std::cos(b) +
                       (fb - fa) / (b - a) * (std::sin(b) - std::sin(a)));
    }
  }
  return sum;
}

double guess_street_side(const IntensityGrid& grid, double usual) {
  constexpr double clearly = 1.08, alike = 0.05;
  const auto flux = quarters(grid);
  const double along_0 = flux[0] + flux[2], along_90 = flux[1] + flux[3];
  // If only one of two planes mirrors the light, the street lies in that plane.
  const bool mirror_0 = mirror_error(grid, 0) < alike, mirror_90 = mirror_error(grid, 90) < alike;
  std::size_t side;
  if (mirror_0 != mirror_90)
    side = mirror_0 ? 0 : 1;
  else if (along_0 > clearly * along_90)
    side = 1;
  else if (along_90 > clearly * along_0)
    side = 0;
  else
    return usual;
  const double one = flux[side], other = flux[side + 2];
  if (std::max(one, other) < clearly * std::min(one, other)) {
    // Both sides are alike: a luminaire for the middle of a road. Keep the usual side if it lies
    // across the road.
    const bool fits = static_cast<std::size_t>(usual / 90) % 2 == side;
    return fits ? usual : 90.0 * static_cast<double>(side);
  }
  return 90.0 * static_cast<double>(one > other ? side : side + 2);
}

Photometry Luminaire::photometry() const {
  // The narrowest ramp that a lower cut-off gets: a regular grid cannot jump.
  constexpr double finest_ramp = 0.1;
  const double c_step =
      grid.c_degrees.size() == 1 ? 360 : common_step(grid.c_degrees, street_side_degrees, 360);
  const double first = grid.gamma_degrees.front(), last = grid.gamma_degrees.back();
  double gamma_step = common_step(grid.gamma_degrees, 0, last);
  if (first > 0) gamma_step /= std::ceil(gamma_step / finest_ramp - 1e-9);
  const double steps = std::max(1.0, std::ceil(last / gamma_step - 1e-6));
  // The ramp lies on the bright side of a lower cut-off, so that nothing shines on the dark one.
  const double lit_from = first > 0 ? first + last / steps - 1e-6 : 0;
  return sample_intensity(
      [&](double c, double gamma) {
        const double degrees = std::min(gamma * 180 / pi, last);
        if (degrees < lit_from) return 0.0;
        // A light's C turns towards cross(axis, tangent): clockwise seen from above.
        return intensity_at(grid, street_side_degrees - c * 180 / pi, degrees);
      },
      static_cast<std::uint32_t>(std::lround(360 / c_step)),
      static_cast<std::uint32_t>(std::lround(steps)) + 1, last);
}

bool begins_as_ies(std::string_view text) {
  bool found = false;
  for_each_line(text, [&](std::string_view line) {
    const std::string start = to_lower(line.substr(0, 16));
    found = is_tilt_line(line) || start.starts_with("iesna") || start.starts_with("ies:lm-63");
    return !found;
  });
  return found;
}

bool begins_as_eulumdat(std::string_view text) {
  struct Line {
    double least, greatest;
    bool whole;
  };
  // After the maker: type, symmetry, C planes and their distance, gamma angles and theirs.
  constexpr std::array<Line, 6> wanted{{{0, 3, true},
                                        {0, 4, true},
                                        {1, 721, true},
                                        {0, 360, false},
                                        {2, 721, true},
                                        {0, 180, false}}};
  std::size_t number = 0;
  bool fits = true;
  for_each_line(text, [&](std::string_view line) {
    if (number++ == 0) return true;
    const Line& expected = wanted[number - 2];
    std::string digits(line);
    std::replace(digits.begin(), digits.end(), ',', '.');
    const auto value = city::parse_number(digits);
    const bool is_left_out = digits.empty() && !expected.whole;  // a distance that nobody needs
    fits = is_left_out || (value && *value >= expected.least && *value <= expected.greatest &&
                           (!expected.whole || *value == std::floor(*value)));
    return fits && number <= wanted.size();
  });
  return fits && number > wanted.size();
}

Luminaire read_luminaire(const std::filesystem::path& file) {
  if (city::find_packing_of(file) != city::Packing::none) return read_packed_luminaire(file);
  return read_luminaire(TextLines(file));
}

Luminaire read_luminaire(const TextLines& lines) {
  if (begins_as_tm33(lines.text())) return read_tm33(lines);
  if (begins_as_ies(lines.text())) return read_ies(lines);
  try {
    return read_eulumdat(lines);
  } catch (const Error& error) {
    if (begins_as_eulumdat(lines.text())) throw;
    if (const std::string what = city::name_foreign(lines.text(), ""); !what.empty())
      throw Error(lines.file(), what + "; photometry is IES LM-63, EULUMDAT, TM-33 or GLDF");
    throw Error("", std::string(error.what()) +
                        "; it has no TILT= line either, so it is neither EULUMDAT nor IES");
  }
}

}  // namespace nightcity::lights
