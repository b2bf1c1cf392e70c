#include "tools/terrain/loose_points.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/decimal.h"

namespace nightcity::terrain {
namespace {

struct LoosePoint {
  double x, y;
  float z;
};

// Passes each line of a file to `take`, without its end.
template <class Take>
void visit_lines(const std::string& path, const Take& take) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> file(VSIFOpenL(path.c_str(), "rb"),
                                                           VSIFCloseL);
  if (!file) return;
  std::string pending;
  std::vector<char> bytes(piece);
  for (std::size_t got; (got = VSIFReadL(bytes.data(), 1, piece, file.get())) > 0;) {
    pending.append(bytes.data(), got);
    std::string_view rest = pending;
    for (std::size_t end; (end = rest.find_first_of("\r\n")) != rest.npos;) {
      take(rest.substr(0, end));
      rest.remove_prefix(end + 1);
    }
    pending.erase(0, pending.size() - rest.size());
    if (pending.size() > piece) return;  // no table has a line as long
  }
  take(std::string_view(pending));
}

class TableReader {
 public:
  explicit TableReader(std::size_t max_points) : max_points_(max_points) {}

  void take(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == line.npos || line[first] == '#' || is_too_long) return;
    if (!is_begun_) {
      find_separators(line);
      if (!is_headed_ && !is_number_start(line[first])) return find_columns(line);
      is_begun_ = true;
    }
    std::array<double, 3> values{};
    std::size_t found = 0, column = 0;
    visit_words(line, [&](std::string_view word) {
      for (std::size_t i = 0; i < columns_.size(); ++i)
        if (columns_[i] == column)
          if (const auto number = parse(word)) values[i] = *number, ++found;
      ++column;
    });
    if (found != columns_.size()) return;
    if (points.size() == max_points_)
      is_too_long = true;
    else
      points.push_back({values[0], values[1], static_cast<float>(values[2])});
  }

  std::vector<LoosePoint> points;
  bool is_too_long = false;

 private:
  static bool is_number_start(char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == '"';
  }

  // A comma parts columns unless something else does: then it stands before decimals.
  void find_separators(std::string_view line) {
    line.remove_prefix(line.find_first_not_of(" \t"));
    line = line.substr(0, line.find_last_not_of(" \t") + 1);
    const bool has_semicolon = line.find(';') != line.npos,
               has_blank = line.find_first_of(" \t") != line.npos,
               has_comma = line.find(',') != line.npos;
    // "1,5 2,5 3,5" has decimals, "1.5, 2.5, 3.5" has columns.
    const bool is_between = line.find(", ") != line.npos || line.find(",\t") != line.npos ||
                            line.find('.') != line.npos;
    comma_is_decimal_ = has_comma && (has_semicolon || (has_blank && !is_between));
  }

  bool is_between(char c) const {
    return c == ' ' || c == '\t' || c == ';' || (c == ',' && !comma_is_decimal_);
  }

  template <class Take>
  void visit_words(std::string_view line, const Take& take) const {
    for (std::size_t at = 0; at < line.size();) {
      while (at < line.size() && is_between(line[at])) ++at;
      std::size_t end = at;
      while (end < line.size() && !is_between(line[end])) ++end;
      if (end > at) take(line.substr(at, end - at));
      at = end;
    }
  }

  static std::string_view drop_quotes(std::string_view word) {
    while (word.starts_with('"')) word.remove_prefix(1);
    while (word.ends_with('"')) word.remove_suffix(1);
    return word;
  }

  void find_columns(std::string_view headings) {
    std::size_t column = 0;
    visit_words(headings, [&](std::string_view raw) {
      const std::string word = to_lower(drop_quotes(raw));
      if (word == "x" || word.starts_with("lon") || word.starts_with("east"))
        columns_[0] = column;
      else if (word == "y" || word.starts_with("lat") || word.starts_with("north"))
        columns_[1] = column;
      else if (word == "z" || word.starts_with("alt") || word == "height")
        columns_[2] = column;
      ++column;
    });
    is_headed_ = true;
  }

  std::optional<double> parse(std::string_view word) const {
    word = drop_quotes(word);
    if (word.starts_with('+')) word.remove_prefix(1);
    std::array<char, 64> plain{};
    if (word.size() > plain.size()) return std::nullopt;
    std::transform(word.begin(), word.end(), plain.begin(),
                   [](char c) { return c == ',' ? '.' : c; });
    double value = 0;
    const char* const end = plain.data() + word.size();
    const auto [stop, error] = parse_decimal(plain.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
    return value;
  }

  std::size_t max_points_;
  std::array<std::size_t, 3> columns_{0, 1, 2};
  bool is_begun_ = false, is_headed_ = false, comma_is_decimal_ = false;
};

// Places along an axis: the first, and the distance of neighbours.
struct Axis {
  double first = 0, step = 0;
  std::size_t count = 0;

  std::optional<std::size_t> find(double value) const {
    constexpr double tolerance = 0.01;  // of a step
    const double at = (value - first) / step, nearest = std::round(at);
    if (std::abs(at - nearest) > tolerance) return std::nullopt;
    return static_cast<std::size_t>(nearest);
  }
};

// Returns the axis on which all values lie, if they lie on any.
std::optional<Axis> find_axis(std::vector<double> values) {
  constexpr double max_count = 1e6;
  std::sort(values.begin(), values.end());
  const double range = values.back() - values.front(), least = range * 0.1 / max_count;
  double step = range;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double distance = values[i] - values[i - 1]; distance > least)
      step = std::min(step, distance);
  if (!(range > 0) || range / step > max_count) return std::nullopt;
  // Rounding makes the smallest distance too short: the whole range tells the mean.
  const double count = std::round(range / step);
  return Axis{values.front(), range / count, static_cast<std::size_t>(count) + 1};
}

std::optional<Axis> find_axis(const std::vector<LoosePoint>& points, double LoosePoint::*member) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const LoosePoint& point : points) values.push_back(point.*member);
  const auto axis = find_axis(std::move(values));
  if (!axis || !std::all_of(points.begin(), points.end(), [&](const LoosePoint& point) {
        return axis->find(point.*member).has_value();
      }))
    return std::nullopt;
  return axis;
}

std::string write_place(const LoosePoint& point) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%.10g %.10g", point.x, point.y);
  return text.data();
}

// Heights by row from the north.
std::vector<float> fill_grid(const std::vector<LoosePoint>& points, const Axis& x, const Axis& y,
                             const std::string& name) {
  constexpr float rounding_m = 0.001F;
  std::vector<float> heights(x.count * y.count, std::numeric_limits<float>::quiet_NaN());
  for (const LoosePoint& point : points) {
    float& height = heights[(y.count - 1 - *y.find(point.y)) * x.count + *x.find(point.x)];
    if (!std::isnan(height) && std::abs(height - point.z) > rounding_m)
      throw Error(name, "has two heights in one place, at " + write_place(point) +
                            ": keep the points of the ground alone");
    height = point.z;
  }
  return heights;
}

}  // namespace

GDALDatasetUniquePtr grid_loose_points(const std::string& path, const std::string& name,
                                       std::size_t max_points) {
  constexpr std::size_t least_share = 8;
  TableReader table(max_points);
  visit_lines(path, [&](std::string_view line) { table.take(line); });
  if (table.is_too_long)
    throw Error(name, "has more than " + std::to_string(max_points) +
                          " points in no order, which would be held in memory: sort them by "
                          "northing and easting (sort -k2,2g -k1,1g)");
  const std::vector<LoosePoint>& points = table.points;
  if (points.size() < 4) return nullptr;
  const auto x = find_axis(points, &LoosePoint::x), y = find_axis(points, &LoosePoint::y);
  if (!x || !y || x->count > points.size() * least_share / y->count) return nullptr;
  const auto width = static_cast<int>(x->count), height = static_cast<int>(y->count);
  std::vector<float> heights = fill_grid(points, *x, *y, name);
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDatasetUniquePtr raster(driver ? driver->Create("", width, height, 1, GDT_Float32, nullptr)
                                     : nullptr);
  std::array<double, 6> place{x->first - x->step / 2,
                              x->step,
                              0,
                              y->first + (static_cast<double>(height) - 0.5) * y->step,
                              0,
                              -y->step};
  if (!raster || raster->SetGeoTransform(place.data()) != CE_None ||
      raster->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, width, height, heights.data(), width,
                                         height, GDT_Float32, 0, 0) != CE_None)
    return nullptr;
  return raster;
}

}  // namespace nightcity::terrain
