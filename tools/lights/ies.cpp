// ANSI/IES LM-63: keyword lines, a TILT line, then numbers whose line breaks mean nothing.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "tools/lights/ies_table.h"
#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"

namespace nightcity::lights {
namespace {

double sample(const IesTable& file, double horizontal, double vertical) {
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
    return file.candela[i * file.vertical.size() + j];
  };
  return (1 - th) * ((1 - tv) * at(h, v) + tv * at(h, v + 1)) +
         th * ((1 - tv) * at(h + 1, v) + tv * at(h + 1, v + 1));
}

/// Unfolds a file of type C, which lists only the planes of one symmetry sector.
IntensityGrid unfold_c(const TextLines& lines, IesTable file) {
  if (file.vertical.front() < 0 || file.vertical.back() > 180)
    lines.fail(file.vertical_line, "vertical angles of type C lie between 0 and 180");
  const double first = file.horizontal.front(), last = file.horizontal.back();
  IntensityGrid grid;
  grid.gamma_degrees = file.vertical;
  if (file.horizontal.size() == 1) {
    grid.c_degrees = {0};
    grid.candela = file.candela;
    return grid;
  }
  const auto is = [](double angle, double wanted) { return std::abs(angle - wanted) < 1e-6; };
  const bool half = is(first, 0) && is(last, 180), quarter = is(first, 0) && is(last, 90),
             turned_half = is(first, 90) && is(last, 270);
  // Many files leave out the plane at 360 degrees, because it repeats that at 0.
  const double last_step = last - file.horizontal[file.horizontal.size() - 2];
  const bool lacks_end = is(last + last_step, first + 360);
  const bool whole =
      !half && !quarter && first > -360 && first < 360 && (is(last, first + 360) || lacks_end);
  if (!(whole || half || quarter || turned_half))
    lines.fail(file.horizontal_line,
               "horizontal angles of type C run from 0 to 90, 180 or 360, or from 90 to 270");
  if (whole && lacks_end) {
    file.horizontal.push_back(first + 360);
    const auto count = static_cast<std::ptrdiff_t>(file.vertical.size());
    const std::vector<double> row(file.candela.begin(), file.candela.begin() + count);
    file.candela.insert(file.candela.end(), row.begin(), row.end());
  }
  // Finds the plane of the file that stands for a plane of the whole turn.
  const auto fold = [&](double c) {
    if (quarter) {
      c = c > 180 ? 360 - c : c;
      return c > 90 ? 180 - c : c;
    }
    if (half) return c > 180 ? 360 - c : c;
    if (turned_half) return c < 90 ? 180 - c : c > 270 ? 540 - c : c;
    return first + std::fmod(c - first + 720, 360);  // a turn may begin anywhere, as -180 or 15
  };
  std::vector<double> planes;
  if (whole) planes.push_back(0);
  for (const double angle : file.horizontal) {
    planes.push_back(angle);
    if (quarter || half) planes.push_back(360 - angle);
    if (quarter) planes.insert(planes.end(), {180 - angle, 180 + angle});
    if (turned_half) planes.push_back(angle <= 180 ? 180 - angle : 540 - angle);
  }
  for (double& plane : planes) {
    if (plane < -1e-6) plane += 360;
    if (plane > 360 - 1e-6) plane -= 360;
  }
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

double finest_step(const std::vector<double>& angles) {
  double finest = 180;
  for (std::size_t n = 1; n < angles.size(); ++n)
    finest = std::min(finest, angles[n] - angles[n - 1]);
  return finest;
}

constexpr int plane_step = 2;  // degrees between the C planes of a resampled file

/// Returns the candela in a direction of a grid. Where the file's angles end, light ends at once; a
/// grid ramps to its next row, so that rows at the edge take the mean over their cell, which keeps
/// the flux.
double mean_at_edge(const std::function<std::optional<double>(double, double)>& find_candela,
                    double c, double gamma, double row_step) {
  constexpr int parts = 5;
  const std::optional<double> here = find_candela(c, gamma);
  const auto at = [&](double along_c, double along_gamma) {  // from -0.5 to 0.5
    return find_candela(c + plane_step * along_c,
                        std::clamp(gamma + row_step * along_gamma, 0.0, 90.0));
  };
  bool is_edge = false;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      is_edge = is_edge || at(x, y).has_value() != here.has_value();
  if (!is_edge) return here.value_or(0);
  double sum = 0;
  for (int i = 0; i < parts; ++i)
    for (int k = 0; k < parts; ++k)
      sum += at((i + 0.5) / parts - 0.5, (k + 0.5) / parts - 0.5).value_or(0);
  return sum / (parts * parts);
}

/// Resamples a file of type A or B round the beam, in steps of a degree or of the file's own angles
/// if they are finer. Such files count angles
/// from an axis across the beam; here the beam is gamma = 0 and C = 0 is "up", so that a floodlight
/// tilted off the nadir stays upright. Right is C = 270, because files of type C count
/// anticlockwise from above.
IntensityGrid resample_ab(const TextLines& lines, const IesTable& file) {
  constexpr double degree = std::numbers::pi / 180;
  const auto in_range = [&](const std::vector<double>& angles, double low, double high,
                            const char* what, std::size_t line) {
    if (angles.front() < low - 1e-6 || angles.back() > high + 1e-6)
      lines.fail(line, std::string(what) + " angles of types A and B lie between -90 and 90");
  };
  if (file.horizontal.size() == 1)
    lines.fail(
        file.horizontal_line,
        "one horizontal angle does not say what a luminaire of type A or B gives to the sides");
  in_range(file.vertical, -90, 90, "vertical", file.vertical_line);
  in_range(file.horizontal, -90, 90, "horizontal", file.horizontal_line);
  // A list that starts at 0 is mirrored.
  const bool mirror_h = file.horizontal.front() >= 0, mirror_v = file.vertical.front() >= 0;
  IntensityGrid grid;
  for (int c = 0; c < 360; c += plane_step) grid.c_degrees.push_back(c);
  // Their angles end at 90 degrees from the beam: behind it there is no light.
  const double finest =
      std::clamp(std::min(finest_step(file.horizontal), finest_step(file.vertical)), 0.1, 1.0);
  const auto rows = static_cast<int>(std::ceil(90 / finest - 1e-6));
  for (int n = 0; n <= rows; ++n) grid.gamma_degrees.push_back(90.0 * n / rows);
  // Returns the candela in a direction; none beyond the file's angles.
  const auto find_candela = [&](double c, double gamma) -> std::optional<double> {
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
                         h <= file.horizontal.back() + 1e-6 && v >= file.vertical.front() - 1e-6 &&
                         v <= file.vertical.back() + 1e-6;
    return covered ? std::optional(sample(file, h, v)) : std::nullopt;
  };
  for (const double c : grid.c_degrees)
    for (const double gamma : grid.gamma_degrees)
      grid.candela.push_back(mean_at_edge(find_candela, c, gamma, 90.0 / rows));
  return grid;
}

/// Returns the text in upper case and without blanks: keywords vary in both.
std::string squeeze(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t') result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return result;
}

/// Returns the text after a keyword like "[LUMINAIRE]", if the line begins with it.
std::optional<std::string> text_after(std::string_view line, std::string_view keyword) {
  if (line.size() < keyword.size() || squeeze(line.substr(0, keyword.size())) != keyword)
    return std::nullopt;
  line.remove_prefix(keyword.size());
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return std::string(line);
}

std::string_view find_first_text(const TextLines& lines) {
  for (const TextLines::Line& line : lines.all())
    if (!line.text.empty()) return line.text;
  return {};
}

}  // namespace

IntensityGrid unfold_table(const TextLines& lines, const IesTable& table) {
  return table.type == 1 ? unfold_c(lines, table) : resample_ab(lines, table);
}

bool is_tilt_line(std::string_view line) {
  return squeeze(line).starts_with("TILT=");
}

Luminaire read_ies(const std::filesystem::path& file) {
  return read_ies(TextLines(file));
}

Luminaire read_ies(const TextLines& lines) {
  Luminaire luminaire;
  std::size_t tilt = 0;
  for (; tilt < lines.all().size() && !is_tilt_line(lines.all()[tilt].text); ++tilt) {
    const std::string_view line = lines.all()[tilt].text;
    if (const auto name = text_after(line, "[LUMINAIRE]")) luminaire.name = *name;
    if (const auto maker = text_after(line, "[MANUFAC]")) luminaire.manufacturer = *maker;
  }
  if (tilt == lines.all().size())
    lines.fail(lines.all().back().number, "no TILT= line: not an IES LM-63 file");
  const std::string source = squeeze(lines.all()[tilt].text).substr(5);
  if (source.empty()) lines.fail(lines.all()[tilt].number, "TILT= names no source");
  if (source != "NONE" && source != "INCLUDE")
    luminaire.notes.push_back("TILT=" + source + " is not read: lamps hang as they were measured");

  const auto tilts =
      std::count_if(lines.all().begin(), lines.all().end(),
                    [](const TextLines::Line& line) { return is_tilt_line(line.text); });
  const IesTable table =
      read_ies_table(lines, tilt + 1, source == "INCLUDE", find_lm63_year(find_first_text(lines)));
  if (tilts > 1)
    luminaire.notes.push_back("the file holds " + std::to_string(tilts) +
                              " luminaires, of which the first is read");
  else if (table.has_text_after)
    luminaire.notes.push_back("the text after the candela values is not read");
  luminaire.width_m = table.width_m;
  luminaire.length_m = table.length_m;
  luminaire.height_m = table.height_m;
  luminaire.stated_flux_lm = table.stated_flux_lm;
  luminaire.grid = unfold_table(lines, table);
  luminaire.flux_lm = integrated_flux(luminaire.grid);
  if (!(luminaire.flux_lm > 0)) lines.fail(table.last_line, "the luminaire gives no light");
  // RP-8's lateral angle 0 faces the street.
  luminaire.street_side_degrees = table.type == 1 ? guess_street_side(luminaire.grid, 0) : 0;
  return luminaire;
}

}  // namespace nightcity::lights
