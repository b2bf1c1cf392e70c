// ANSI/IES LM-63: keyword lines, a TILT line, then numbers whose line breaks mean nothing.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"

namespace nightcity {
namespace {

constexpr int max_angles = 20000;
constexpr double foot_m = 0.3048;

/// Reads numbers one after another, each with the number of its line.
class Numbers {
 public:
  Numbers(const TextLines& lines, std::size_t first_line) : lines_(lines), line_(first_line) {}

  double next(std::string_view what) {
    const std::string_view text = token(what);
    return lines_.number(text, at_, what);
  }
  int next_integer(std::string_view what, int low, int high) {
    const std::string_view text = token(what);
    return lines_.integer(text, at_, what, low, high);
  }
  /// Reads ascending angles.
  std::vector<double> angles(int count, std::string_view what) {
    std::vector<double> result;
    for (int n = 0; n < count; ++n) {
      result.push_back(next(what));
      if (n > 0 && result[result.size() - 1] <= result[result.size() - 2])
        lines_.fail(at_, std::string(what) + " do not ascend");
    }
    return result;
  }
  std::size_t line() const { return at_; }

 private:
  std::string_view token(std::string_view what) {
    // Numbers are separated by blanks, in older files also by commas.
    constexpr std::string_view separators = " \t,";
    while (true) {
      const std::size_t first = rest_.find_first_not_of(separators);
      if (first != std::string_view::npos) {
        rest_.remove_prefix(first);
        const std::size_t end = std::min(rest_.find_first_of(separators), rest_.size());
        const std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return text;
      }
      if (line_ >= lines_.all().size())
        lines_.fail(lines_.all().size(),
                    "the file ends where " + std::string(what) + " should stand");
      rest_ = lines_.all()[line_].text;
      at_ = lines_.all()[line_].number;
      ++line_;
    }
  }

  const TextLines& lines_;
  std::size_t line_, at_ = 0;
  std::string_view rest_;
};

struct Header {
  int type;  // 1 = C, 2 = B, 3 = A
  double stated_flux_lm, scale;
  std::vector<double> vertical, horizontal;
  std::vector<double> values;  // horizontal * vertical count + vertical
  std::size_t angles_line;
};

double sample(const Header& file, double horizontal, double vertical) {
  IntensityGrid plain{file.horizontal, file.vertical, {}};
  const auto place = [](const std::vector<double>& angles, double angle, double& t) -> std::size_t {
    if (angles.size() == 1) return t = 0, 0;
    const auto next = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const auto index = static_cast<std::size_t>(next - angles.begin()) - 1;
    t = std::clamp((angle - angles[index]) / (angles[index + 1] - angles[index]), 0.0, 1.0);
    return index;
  };
  double th, tv;
  const std::size_t h = place(file.horizontal, horizontal, th),
                    v = place(file.vertical, vertical, tv);
  const auto at = [&](std::size_t i, std::size_t j) {
    i = std::min(i, file.horizontal.size() - 1);
    j = std::min(j, file.vertical.size() - 1);
    return file.values[i * file.vertical.size() + j];
  };
  return (1 - th) * ((1 - tv) * at(h, v) + tv * at(h, v + 1)) +
         th * ((1 - tv) * at(h + 1, v) + tv * at(h + 1, v + 1));
}

/// Unfolds a file of type C, which lists only the planes of one symmetry sector.
IntensityGrid unfold_c(const TextLines& lines, const Header& file) {
  if (file.vertical.front() < 0 || file.vertical.back() > 180)
    lines.fail(file.angles_line, "vertical angles of type C lie between 0 and 180");
  const double first = file.horizontal.front(), last = file.horizontal.back();
  IntensityGrid grid;
  grid.gamma_degrees = file.vertical;
  if (file.horizontal.size() == 1) {
    grid.c_degrees = {0};
    grid.candela = file.values;
    return grid;
  }
  const auto is = [](double angle, double wanted) { return std::abs(angle - wanted) < 1e-6; };
  const bool whole = is(first, 0) && is(last, 360), half = is(first, 0) && is(last, 180),
             quarter = is(first, 0) && is(last, 90), turned_half = is(first, 90) && is(last, 270);
  if (!(whole || half || quarter || turned_half))
    lines.fail(file.angles_line,
               "horizontal angles of type C run from 0 to 90, 180 or 360, or from 90 to 270");
  // Finds the plane of the file that stands for a plane of the whole turn.
  const auto fold = [&](double c) {
    if (quarter) {
      c = c > 180 ? 360 - c : c;
      return c > 90 ? 180 - c : c;
    }
    if (half) return c > 180 ? 360 - c : c;
    if (turned_half) return c < 90 ? 180 - c : c > 270 ? 540 - c : c;
    return c;
  };
  std::vector<double> planes;
  for (const double angle : file.horizontal) {
    planes.push_back(angle);
    if (quarter || half) planes.push_back(360 - angle);
    if (quarter) planes.insert(planes.end(), {180 - angle, 180 + angle});
    if (turned_half) planes.push_back(angle <= 180 ? 180 - angle : 540 - angle);
  }
  for (double& plane : planes)
    if (plane > 360 - 1e-6) plane -= 360;
  std::sort(planes.begin(), planes.end());
  planes.erase(
      std::unique(planes.begin(), planes.end(), [](double a, double b) { return b - a < 1e-6; }),
      planes.end());
  grid.c_degrees = planes;
  for (const double plane : planes)
    for (const double gamma : file.vertical)
      grid.candela.push_back(sample(file, fold(plane), gamma));
  return grid;
}

/// Resamples a file of type A or B in steps of a degree round the beam. Such files count angles
/// from an axis across the beam; here the beam is gamma = 0 and C = 0 is "up", so that a floodlight
/// tilted off the nadir stays upright. Right is C = 270, because files of type C count
/// anticlockwise from above.
IntensityGrid resample_ab(const TextLines& lines, const Header& file) {
  constexpr double degree = std::numbers::pi / 180;
  const auto in_range = [&](const std::vector<double>& angles, double low, double high,
                            const char* what) {
    if (angles.front() < low - 1e-6 || angles.back() > high + 1e-6)
      lines.fail(file.angles_line,
                 std::string(what) + " angles of types A and B lie between -90 and 90");
  };
  in_range(file.vertical, -90, 90, "vertical");
  in_range(file.horizontal, -90, 90, "horizontal");
  // A list that starts at 0 is mirrored.
  const bool mirror_h = file.horizontal.front() >= 0, mirror_v = file.vertical.front() >= 0;
  IntensityGrid grid;
  for (int c = 0; c < 360; c += 2) grid.c_degrees.push_back(c);
  for (int gamma = 0; gamma <= 180; ++gamma) grid.gamma_degrees.push_back(gamma);
  for (const double c : grid.c_degrees)
    for (const double gamma : grid.gamma_degrees) {
      const double beam = std::cos(gamma * degree);
      const double up = std::sin(gamma * degree) * std::cos(c * degree);
      const double right = -std::sin(gamma * degree) * std::sin(c * degree);
      double h, v;
      if (file.type == 3) {  // A: V is the elevation above the beam's plane, H the azimuth
        v = std::asin(std::clamp(up, -1.0, 1.0));
        h = std::atan2(right, beam);
      } else {  // B: H is the elevation, V the azimuth
        h = std::asin(std::clamp(right, -1.0, 1.0));
        v = std::atan2(up, beam);
      }
      h /= degree;
      v /= degree;
      if (mirror_h) h = std::abs(h);
      if (mirror_v) v = std::abs(v);
      const bool covered = h >= file.horizontal.front() - 1e-6 &&
                           h <= file.horizontal.back() + 1e-6 &&
                           v >= file.vertical.front() - 1e-6 && v <= file.vertical.back() + 1e-6;
      grid.candela.push_back(covered || file.horizontal.size() == 1 ? sample(file, h, v) : 0);
    }
  return grid;
}

}  // namespace

Luminaire read_ies(const std::filesystem::path& path) {
  const TextLines lines(path);
  Luminaire luminaire;
  std::size_t tilt = 0;
  for (; tilt < lines.all().size(); ++tilt) {
    const std::string_view text = lines.all()[tilt].text;
    if (text.starts_with("TILT=")) break;
    const auto value_of = [&](std::string_view key) {
      return std::string(text.substr(std::min(key.size(), text.size())));
    };
    const auto trimmed = [](std::string value) {
      return value.erase(0, std::min(value.find_first_not_of(' '), value.size()));
    };
    if (text.starts_with("[LUMINAIRE]")) luminaire.name = trimmed(value_of("[LUMINAIRE]"));
    if (text.starts_with("[MANUFAC]")) luminaire.manufacturer = trimmed(value_of("[MANUFAC]"));
  }
  if (tilt == lines.all().size())
    lines.fail(lines.all().back().number, "no TILT= line: not an IES LM-63 file");

  Numbers numbers(lines, tilt + 1);
  if (lines.all()[tilt].text == "TILT=INCLUDE") {
    // The TILT data say how the lamp's output falls when the luminaire is tilted. Ours hang as
    // they were measured.
    numbers.next_integer("the lamp's position", 1, 3);
    const int pairs = numbers.next_integer("the number of tilt angles", 1, max_angles);
    for (int n = 0; n < 2 * pairs; ++n) numbers.next("the tilt table");
  }
  Header header;
  const double lamps = numbers.next("the number of lamps"), lumens = numbers.next("lumens a lamp");
  const double multiplier = numbers.next("the candela multiplier");
  const int vertical = numbers.next_integer("the number of vertical angles", 2, max_angles);
  const int horizontal = numbers.next_integer("the number of horizontal angles", 1, max_angles);
  if (static_cast<std::size_t>(vertical) * static_cast<std::size_t>(horizontal) > 4'000'000)
    lines.fail(numbers.line(), "more angles than any file has");
  header.type = numbers.next_integer("the photometric type", 1, 3);
  const double unit = numbers.next_integer("the unit (1 feet, 2 metres)", 1, 2) == 1 ? foot_m : 1;
  // Negative sizes stand for round openings (LM-63-2002).
  luminaire.width_m = std::abs(numbers.next("the width")) * unit;
  luminaire.length_m = std::abs(numbers.next("the length")) * unit;
  luminaire.height_m = std::abs(numbers.next("the height")) * unit;
  const double ballast = numbers.next("the ballast factor"),
               ballast_lamp = numbers.next("the ballast-lamp factor");
  numbers.next("input watts");
  header.scale = multiplier * ballast * ballast_lamp;
  if (!(header.scale > 0)) lines.fail(numbers.line(), "multiplier and factors must be above zero");
  header.vertical = numbers.angles(vertical, "vertical angles");
  header.angles_line = numbers.line();
  header.horizontal = numbers.angles(horizontal, "horizontal angles");
  const auto total = static_cast<std::size_t>(vertical) * static_cast<std::size_t>(horizontal);
  header.values.reserve(total);
  for (std::size_t n = 0; n < total; ++n) {
    const double candela = numbers.next("candela values");
    if (candela < 0) lines.fail(numbers.line(), "negative candela");
    header.values.push_back(candela * header.scale);
  }

  luminaire.grid = header.type == 1 ? unfold_c(lines, header) : resample_ab(lines, header);
  luminaire.flux_lm = integrated_flux(luminaire.grid);
  if (!(luminaire.flux_lm > 0)) lines.fail(numbers.line(), "the luminaire gives no light");
  luminaire.stated_flux_lm = lumens > 0 ? lamps * lumens : 0;
  // RP-8's lateral angle 0 faces the street.
  luminaire.street_side_degrees = header.type == 1 ? guess_street_side(luminaire.grid, 0) : 0;
  return luminaire;
}

}  // namespace nightcity
