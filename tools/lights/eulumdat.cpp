// EULUMDAT (Stockmar 1990): one value a line, in a fixed order, candela per 1000 lumens of the lamps.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"

namespace nightcity {
namespace {

constexpr int max_angles = 721;

/// Walks down the lines.
class Cursor {
 public:
  explicit Cursor(const TextLines& lines) : lines_(lines) {}

  std::string_view text(std::string_view what) {
    if (next_ >= lines_.all().size())
      lines_.fail(lines_.all().size(),
                  "the file ends where " + std::string(what) + " should stand");
    line_ = lines_.all()[next_].number;
    return lines_.all()[next_++].text;
  }
  double number(std::string_view what) { return lines_.number(text(what), line_, what); }
  int integer(std::string_view what, int low, int high) {
    const std::string_view value = text(what);
    return lines_.integer(value, line_, what, low, high);
  }
  void skip(int count, std::string_view what) {
    for (int n = 0; n < count; ++n) text(what);
  }
  std::vector<double> angles(int count, double high, std::string_view what) {
    std::vector<double> result;
    for (int n = 0; n < count; ++n) {
      result.push_back(number(what));
      if (result.back() < 0 || result.back() > high ||
          (n > 0 && result.back() <= result[result.size() - 2]))
        lines_.fail(line_, std::string(what) + " do not ascend from 0");
    }
    return result;
  }
  std::size_t line() const { return line_; }

 private:
  const TextLines& lines_;
  std::size_t next_ = 0, line_ = 0;
};

/// The listed plane that stands for the plane at `c`, by the file's symmetry.
double fold(int symmetry, double c) {
  switch (symmetry) {
    case 1:
      return 0;  // about the vertical axis
    case 2:
      return c > 180 ? 360 - c : c;  // about the plane C0-C180
    case 3:
      return c > 90 && c < 270 ? (c <= 180 ? 180 - c : 540 - c)
                               : c;  // about C90-C270: lists C270 to C90
    case 4:
      c = c > 180 ? 360 - c : c;
      return c > 90 ? 180 - c : c;
    default:
      return c;
  }
}

}  // namespace

Luminaire read_eulumdat(const std::filesystem::path& path) {
  const TextLines lines(path);
  Cursor at(lines);
  Luminaire luminaire;
  luminaire.manufacturer = at.text("the maker");
  at.integer("the type of luminaire", 0, 3);
  const int symmetry = at.integer("the symmetry", 0, 4);
  const int planes = at.integer("the number of C planes", 1, max_angles);
  at.number("the distance of C planes");
  const int gammas = at.integer("the number of gamma angles", 2, max_angles);
  at.number("the distance of gamma angles");
  at.text("the report's number");
  luminaire.name = at.text("the luminaire's name");
  at.skip(3, "number, file and date");
  at.skip(3, "the luminaire's size");
  luminaire.length_m = at.number("the luminous length") / 1000;
  luminaire.width_m = at.number("the luminous width") / 1000;
  luminaire.height_m = at.number("the luminous height") / 1000;
  at.skip(3, "the luminous heights");
  at.number("the downward flux fraction");
  const double output_ratio = at.number("the light output ratio") / 100;
  double factor = at.number("the conversion factor");
  at.number("the tilt");
  const int sets = at.integer("the number of lamp sets", 1, 20);
  double lamp_flux = 0;
  for (int n = 0; n < sets; ++n) {
    at.number("the number of lamps");  // the flux below is the whole set's
    at.text("the type of lamps");
    const double flux = at.number("the lamps' flux");
    if (n == 0) lamp_flux = flux;  // further sets are alternatives
    at.skip(3, "colour, rendering and power of the lamps");
  }
  if (!(lamp_flux > 0)) lines.fail(at.line(), "the lamps' flux must be above zero");
  if (factor <= 0) factor = 1;
  at.skip(10, "the direct ratios");
  const std::vector<double> listed = at.angles(planes, 360, "C angles");
  luminaire.grid.gamma_degrees = at.angles(gammas, 180, "gamma angles");

  // Only the planes of one symmetry sector follow.
  const std::size_t count = static_cast<std::size_t>(planes);
  std::size_t first = 0, last = count;
  if (symmetry == 1) last = 1;
  if (symmetry == 2) last = count / 2 + 1;
  if (symmetry == 3) first = 3 * count / 4, last = first + count / 2 + 1;
  if (symmetry == 4) last = count / 4 + 1;
  const auto is_multiple = [&](std::size_t of) { return count % of == 0; };
  if ((symmetry == 2 && !is_multiple(2)) || (symmetry > 2 && !is_multiple(4)))
    lines.fail(at.line(),
               std::to_string(count) + " C planes do not fit symmetry " + std::to_string(symmetry));
  std::vector<std::pair<double, std::size_t>> rows;  // angle of the plane, row of values
  std::vector<double> values;
  for (std::size_t n = first; n < last; ++n) {
    rows.emplace_back(listed[n % count], rows.size());
    for (int g = 0; g < gammas; ++g) {
      const double value = at.number("intensities");
      if (value < 0) lines.fail(at.line(), "negative intensity");
      values.push_back(value * factor * lamp_flux / 1000);
    }
  }

  luminaire.grid.c_degrees = symmetry == 1 ? std::vector<double>{0} : listed;
  if (luminaire.grid.c_degrees.back() > 360 - 1e-6) luminaire.grid.c_degrees.pop_back();
  if (std::abs(luminaire.grid.c_degrees.front()) > 1e-6)
    lines.fail(at.line(), "C angles do not begin at 0");
  for (const double plane : luminaire.grid.c_degrees) {
    const double wanted = fold(symmetry, plane);
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) {
      return symmetry == 1 || std::abs(r.first - wanted) < 1e-6 ||
             std::abs(r.first - wanted - 360) < 1e-6;
    });
    if (row == rows.end())
      lines.fail(at.line(), "the C planes are not symmetric as symmetry " +
                                std::to_string(symmetry) + " says");
    const auto from = values.begin() +
                      static_cast<std::ptrdiff_t>(row->second * static_cast<std::size_t>(gammas));
    luminaire.grid.candela.insert(luminaire.grid.candela.end(), from, from + gammas);
  }
  luminaire.flux_lm = integrated_flux(luminaire.grid);
  if (!(luminaire.flux_lm > 0)) lines.fail(at.line(), "the luminaire gives no light");
  luminaire.stated_flux_lm = lamp_flux * output_ratio;
  luminaire.street_side_degrees = guess_street_side(luminaire.grid, 90);
  return luminaire;
}

}  // namespace nightcity
