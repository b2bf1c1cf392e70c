// EULUMDAT (Stockmar 1990): one value on each line, in a fixed order; candela per 1000 lumens
// of the lamps.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"

namespace nightcity::lights {
namespace {

constexpr int max_ldt_angles = 721;

/// Reads one line after the other.
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
  /// Reads a number that may be missing: programs leave lines blank of which they know nothing.
  double number_or(double otherwise, std::string_view what) {
    const std::string_view value = text(what);
    return value.empty() ? otherwise : lines_.number(value, line_, what);
  }
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
  /// Throws where numbers remain: they belong to a table of another size than the head says.
  void expect_end() {
    for (; next_ < lines_.all().size(); ++next_) {
      const TextLines::Line& line = lines_.all()[next_];
      if (line.text.empty() || line.text.find_first_not_of("0123456789.,+-eE \t") != line.text.npos)
        continue;
      lines_.fail(line.number, "numbers remain after the last intensity (\"" +
                                   std::string(line.text.substr(0, 40)) +
                                   "\"): the table is larger than symmetry and angles say");
    }
  }
  std::size_t line() const { return line_; }

 private:
  const TextLines& lines_;
  std::size_t next_ = 0, line_ = 0;
};

/// Returns the listed plane that stands for the plane at `c`, by the symmetry of the file.
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

/// The lines before the intensities.
struct Head {
  Luminaire luminaire;
  int symmetry = 0, gamma_count = 0;
  std::vector<double> planes_degrees;  // all C planes, listed or not
  double lamp_flux_lm = 0, output_ratio = 0, factor = 1;
};

Head read_head(const TextLines& lines, Cursor& at) {
  Head head;
  Luminaire& luminaire = head.luminaire;
  luminaire.manufacturer = at.text("the maker");
  at.integer("the type of luminaire", 0, 3);
  head.symmetry = at.integer("the symmetry", 0, 4);
  const int planes = at.integer("the number of C planes", 1, max_ldt_angles);
  at.number_or(0, "the distance of C planes");
  head.gamma_count = at.integer("the number of gamma angles", 2, max_ldt_angles);
  at.number_or(0, "the distance of gamma angles");
  at.text("the report's number");
  luminaire.name = at.text("the luminaire's name");
  at.skip(3, "number, file and date");
  at.skip(3, "the luminaire's size");
  // Programs that convert IES keep its negative sizes, which stand for round openings.
  luminaire.length_m = std::abs(at.number_or(0, "the luminous length")) / 1000;
  luminaire.width_m = std::abs(at.number_or(0, "the luminous width")) / 1000;
  luminaire.height_m = std::abs(at.number_or(0, "the luminous height")) / 1000;
  at.skip(3, "the luminous heights");
  at.number_or(0, "the downward flux fraction");
  head.output_ratio = at.number_or(0, "the light output ratio") / 100;
  head.factor = at.number_or(1, "the conversion factor");
  if (head.factor <= 0) head.factor = 1;
  at.number_or(0, "the tilt");
  const int sets = at.integer("the number of lamp sets", 1, 20);
  bool others_differ = false;
  for (int n = 0; n < sets; ++n) {
    at.number_or(1, "the number of lamps");  // the flux below is that of the whole set
    at.text("the type of lamps");
    const double flux = at.number("the lamps' flux");
    if (n == 0) head.lamp_flux_lm = flux;  // further sets are alternatives
    others_differ = others_differ || flux != head.lamp_flux_lm;
    at.skip(3, "colour, rendering and power of the lamps");
  }
  if (!(head.lamp_flux_lm > 0)) lines.fail(at.line(), "the lamps' flux must be above zero");
  if (others_differ)
    luminaire.notes.push_back("the file has " + std::to_string(sets) +
                              " sets of lamps, of which the first is used");
  at.skip(10, "the direct ratios");
  head.planes_degrees = at.angles(planes, 360, "C angles");
  luminaire.grid.gamma_degrees = at.angles(head.gamma_count, 180, "gamma angles");
  return head;
}

/// The planes of one symmetry sector: the only ones whose intensities a file lists.
struct Sector {
  std::vector<double> planes_degrees;
  std::vector<double> candela;  // planes * gamma_count, gamma fastest
};

Sector read_sector(const TextLines& lines, Cursor& at, const Head& head) {
  const std::size_t count = head.planes_degrees.size();
  const int symmetry = head.symmetry;
  std::size_t first = 0, last = count;
  if (symmetry == 1) last = 1;
  if (symmetry == 2) last = count / 2 + 1;
  if (symmetry == 3) first = 3 * count / 4, last = first + count / 2 + 1;
  if (symmetry == 4) last = count / 4 + 1;
  const auto is_multiple = [&](std::size_t of) { return count % of == 0; };
  if ((symmetry == 2 && !is_multiple(2)) || (symmetry > 2 && !is_multiple(4)))
    lines.fail(at.line(),
               std::to_string(count) + " C planes do not fit symmetry " + std::to_string(symmetry));
  Sector sector;
  for (std::size_t n = first; n < last; ++n) {
    sector.planes_degrees.push_back(head.planes_degrees[n % count]);
    for (int g = 0; g < head.gamma_count; ++g) {
      const double value = at.number("intensities");
      if (value < 0) lines.fail(at.line(), "negative intensity");
      sector.candela.push_back(value * head.factor * head.lamp_flux_lm / 1000);
    }
  }
  return sector;
}

/// Fills the grid with the whole turn.
void unfold(const TextLines& lines, const Cursor& at, const Head& head, const Sector& sector,
            IntensityGrid& grid) {
  grid.c_degrees = head.symmetry == 1 ? std::vector<double>{0} : head.planes_degrees;
  if (grid.c_degrees.back() > 360 - 1e-6) grid.c_degrees.pop_back();
  if (std::abs(grid.c_degrees.front()) > 1e-6) lines.fail(at.line(), "C angles do not begin at 0");
  for (const double plane : grid.c_degrees) {
    const double wanted = fold(head.symmetry, plane);
    const auto found = std::find_if(
        sector.planes_degrees.begin(), sector.planes_degrees.end(), [&](double listed) {
          return head.symmetry == 1 || std::abs(listed - wanted) < 1e-6 ||
                 std::abs(listed - wanted - 360) < 1e-6;
        });
    if (found == sector.planes_degrees.end())
      lines.fail(at.line(), "the C planes are not symmetric as symmetry " +
                                std::to_string(head.symmetry) + " says");
    const auto from =
        sector.candela.begin() + (found - sector.planes_degrees.begin()) * head.gamma_count;
    grid.candela.insert(grid.candela.end(), from, from + head.gamma_count);
  }
}

}  // namespace

Luminaire read_eulumdat(const std::filesystem::path& file) {
  return read_eulumdat(TextLines(file));
}

Luminaire read_eulumdat(const TextLines& lines) {
  Cursor at(lines);
  Head head = read_head(lines, at);
  const Sector sector = read_sector(lines, at, head);
  at.expect_end();
  Luminaire& luminaire = head.luminaire;
  unfold(lines, at, head, sector, luminaire.grid);
  luminaire.flux_lm = integrated_flux(luminaire.grid);
  if (!(luminaire.flux_lm > 0)) lines.fail(at.line(), "the luminaire gives no light");
  luminaire.stated_flux_lm = head.lamp_flux_lm * std::max(0.0, head.output_ratio);
  luminaire.street_side_degrees = guess_street_side(luminaire.grid, 90);
  return std::move(luminaire);
}

}  // namespace nightcity::lights
