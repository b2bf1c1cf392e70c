#include "tools/lights/facades.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "tools/lights/wall_plane.h"
#include "tools/random.h"

namespace nightcity::lights {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double edge_margin_m = 0.6;   // bays begin this far from a facade's ends
constexpr double wall_margin_m = 0.12;  // frames keep this far from any edge of their wall
constexpr double min_facade_m = 2.0;
constexpr double plinth_m = 0.8;  // height of the ground floor above the lowest ground
constexpr double min_storey_m = 2.3, max_storey_m = 5.5;

/// Engineering values: storey heights of European housing (2.5 to 3.2 m) and offices (3.3 to 3.8
/// m), and window shares of 15 to 40 % of the facade.
struct Style {
  // Heights used if the model gives no storeys. ground_storey_m 0: the same as the others.
  double storey_m, ground_storey_m;
  double width_m, height_m, sill_m;
  double pitch_low_m, pitch_high_m;  // of the bays
};

Style style_of(BuildingUse use) {
  switch (use) {
    case BuildingUse::residential:
      return {3.0, 0, 1.2, 1.4, 0.9, 2.6, 3.4};
    case BuildingUse::mixed:
      return {3.1, 4.0, 1.2, 1.5, 0.9, 2.6, 3.2};
    case BuildingUse::office:
      return {3.6, 0, 1.7, 1.6, 0.85, 2.4, 3.0};
    case BuildingUse::retail:
      return {4.2, 4.2, 1.6, 1.6, 0.9, 3.0, 4.0};
    case BuildingUse::hotel:
      return {3.1, 4.0, 1.3, 1.5, 0.8, 3.2, 3.8};
    case BuildingUse::education:
      return {3.6, 0, 1.8, 1.8, 0.9, 2.6, 3.2};
    case BuildingUse::civic:
      return {3.8, 0, 1.3, 2.0, 0.9, 2.8, 3.4};
    case BuildingUse::industrial:
      return {5.0, 0, 2.4, 0.9, 3.2, 4.0, 6.0};
    case BuildingUse::dark:
      break;
  }
  return {};
}

constexpr Style shop_front = {0, 0, 2.4, 2.3, 0.5, 3.2, 4.2};

bool has_shops(BuildingUse use) {
  return use == BuildingUse::mixed || use == BuildingUse::retail;
}

/// Returns whether the bay lies in the middle third of the ground floor.
bool has_lobby(BuildingUse use) {
  return use == BuildingUse::hotel || use == BuildingUse::office || use == BuildingUse::civic;
}

/// Coplanar walls side by side.
struct Facade {
  WallFrame frame;
  std::vector<WallOutline> walls;
  double from = 0, to = 0;  // along the frame
};

class Builder {
 public:
  Builder(const city::CityObject& building, BuildingUse use, std::uint64_t seed,
          std::size_t max_windows)
      : building_(building),
        max_windows_(max_windows),
        use_(use),
        style_(style_of(use)),
        random_{static_cast<std::int64_t>(seed),
                static_cast<std::int64_t>(hash_text(building.id))} {}

  std::vector<WindowPlace> lay(FacadeReport& report) {
    if (use_ == BuildingUse::dark) return {};
    take_modelled();
    if (!places_.empty()) return std::move(places_);
    collect_facades();
    if (facades_.empty()) return {};
    find_storeys(report);
    const double stretch = random_.range(0.9, 1.15);  // houses differ a little
    style_.width_m *= stretch;
    for (std::size_t n = 0; n < facades_.size() && n < 65535; ++n)
      fill(facades_[n], static_cast<std::uint16_t>(n));
    if (has_too_many()) {
      ++report.too_many;
      return {};
    }
    return std::move(places_);
  }

 private:
  /// A facade of very many walls is looked through for each window, so these looks are bounded too.
  bool has_too_many() const {
    constexpr std::size_t looks_a_window = 100;
    return places_.size() > max_windows_ || looks_ / looks_a_window > max_windows_;
  }

  void take_modelled() {
    std::uint16_t number = 0;
    for (const city::Polygon& polygon : building_.polygons) {
      if (polygon.surface != city::SurfaceType::window) continue;
      const auto frame = wall_frame(polygon);
      if (!frame) continue;
      const WallOutline outline = outline_in(*frame, polygon);
      const dvec2 size = outline.high - outline.low, middle = (outline.high + outline.low) * 0.5;
      if (!(size.x > 0.2 && size.y > 0.2)) continue;
      WindowPlace place;
      place.centre = frame->from_plane(middle);
      place.normal = frame->normal;
      place.along = frame->along;
      place.half_width = size.x / 2;
      place.half_height = size.y / 2;
      place.bay = number++;
      place.bays = 1;
      place.modelled = true;
      places_.push_back(place);
    }
  }

  void collect_facades() {
    for (const city::Polygon& polygon : building_.polygons) {
      if (polygon.surface != city::SurfaceType::wall) continue;
      const auto frame = wall_frame(polygon);
      if (!frame) continue;
      bottom_ = std::min(bottom_, lowest_of(polygon));
      Facade* home = nullptr;
      for (Facade& facade : facades_) {
        // Join the walls if their planes agree and they touch.
        if (glm::dot(facade.frame.normal, frame->normal) < 0.9994) continue;
        if (std::abs(glm::dot(facade.frame.normal, frame->origin - facade.frame.origin)) > 0.05)
          continue;
        const WallOutline outline = outline_in(facade.frame, polygon);
        if (outline.low.x > facade.to + 0.1 || outline.high.x < facade.from - 0.1) continue;
        home = &facade;
        break;
      }
      if (!home) home = &facades_.emplace_back(Facade{*frame, {}, 1e300, -1e300});
      const WallOutline outline = outline_in(home->frame, polygon);
      home->from = std::min(home->from, outline.low.x);
      home->to = std::max(home->to, outline.high.x);
      home->walls.push_back(outline);
    }
  }

  static double lowest_of(const city::Polygon& polygon) {
    double low = std::numeric_limits<double>::infinity();
    for (const dvec3& p : polygon.exterior) low = std::min(low, p.z);
    return low;
  }

  /// Returns the height at which the walls end and the roof begins. Gables rise above it, so each
  /// wall counts with the lower of its upper corners, and the longest walls decide.
  double eave() const {
    std::vector<std::pair<double, double>> shoulders;  // height, width
    double total = 0;
    for (const Facade& facade : facades_)
      for (const WallOutline& wall : facade.walls) {
        double left = -1e300, right = -1e300;
        for (const dvec2& p : wall.exterior) {
          if (p.x < wall.low.x + 0.05) left = std::max(left, p.y);
          if (p.x > wall.high.x - 0.05) right = std::max(right, p.y);
        }
        const double width = wall.high.x - wall.low.x;
        shoulders.emplace_back(facade.frame.from_plane({0, std::min(left, right)}).z, width);
        total += width;
      }
    std::sort(shoulders.begin(), shoulders.end());
    double sum = 0;
    for (const auto& [height, width] : shoulders)
      if ((sum += width) >= total / 2) return height;
    return shoulders.back().first;
  }

  void find_storeys(FacadeReport& report) {
    const double base = bottom_ + plinth_m, height = eave() - base;
    const double ground =
        style_.ground_storey_m > 0 && height > style_.ground_storey_m ? style_.ground_storey_m : 0;
    if (building_.storeys_above_ground && *building_.storeys_above_ground > 0) {
      const int count = *building_.storeys_above_ground;
      const double upper =
          count > 1 && ground > 0 ? (height - ground) / (count - 1) : height / count;
      if (upper >= min_storey_m && upper <= max_storey_m) {
        ++report.storeys_from_attribute;
        return set_storeys(base, ground > 0 && count > 1 ? ground : upper, upper);
      }
    }
    ++report.storeys_from_height;
    const double first = ground > 0 ? ground : style_.storey_m;
    const double rest = height - first;
    const int upper_count = std::max(0, static_cast<int>(std::lround(rest / style_.storey_m)));
    const double upper = upper_count > 0
                             ? std::clamp(rest / upper_count, min_storey_m, max_storey_m)
                             : style_.storey_m;
    set_storeys(base, ground > 0 ? first : upper, upper);
  }

  void set_storeys(double base, double first, double upper) {
    base_ = base;
    first_storey_ = first;
    upper_storey_ = upper;
  }

  void fill(const Facade& facade, std::uint16_t number) {
    double top = -1e300;
    for (const WallOutline& wall : facade.walls)
      top = std::max(top, facade.frame.from_plane({0, wall.high.y}).z);
    if (facade.to - facade.from < min_facade_m) return;
    // Windows continue into gables; each wall decides whether they fit.
    for (std::uint16_t storey = 0; storey < 400; ++storey) {
      const double floor =
          storey == 0 ? base_ : base_ + first_storey_ + (storey - 1) * upper_storey_;
      if (floor + 1.5 > top || has_too_many()) break;
      const bool shops = storey == 0 && has_shops(use_);
      fill_storey(facade, number, storey, floor, shops ? shop_front : style_, shops);
    }
  }

  void fill_storey(const Facade& facade, std::uint16_t number, std::uint16_t storey, double floor,
                   const Style& style, bool shops) {
    const double usable = facade.to - facade.from - 2 * edge_margin_m;
    const double room = storey == 0 ? first_storey_ : upper_storey_;
    const double height = std::min(style.height_m, room - style.sill_m - 0.3);
    if (height < 0.5 || usable < style.width_m) return;
    // All storeys of a facade have one pitch, which follows from its width alone, so that windows
    // stand above each other.
    Random random{static_cast<std::int64_t>(hash_text(building_.id)), number, shops};
    const double pitch = random.range(style.pitch_low_m, style.pitch_high_m);
    const int bays = std::clamp(static_cast<int>(usable / pitch), 1, 5000);
    const double step = usable / bays;
    const double width = std::min(style.width_m, step - 0.3);
    const int stairs = !shops && use_ == BuildingUse::residential && bays >= 4 && number % 2 == 1
                           ? random.integer(1, bays - 2)
                           : -1;
    const bool lobby = storey == 0 && has_lobby(use_);
    for (int bay = 0; bay < bays; ++bay) {
      looks_ += facade.walls.size();
      const double x = facade.from + edge_margin_m + (bay + 0.5) * step;
      const double z = floor + style.sill_m + height / 2;
      // The height along the wall, which may lean.
      const double y = (z - facade.frame.origin.z) / facade.frame.up.z;
      const dvec2 half(width / 2, height / 2), margin(wall_margin_m);
      const dvec2 low = dvec2(x, y) - half - margin, high = dvec2(x, y) + half + margin;
      const bool fits =
          std::any_of(facade.walls.begin(), facade.walls.end(),
                      [&](const WallOutline& wall) { return contains(wall, low, high); });
      if (!fits) continue;
      WindowPlace place;
      place.centre = facade.frame.from_plane({x, y});
      place.normal = facade.frame.normal;
      place.along = facade.frame.along;
      place.half_width = width / 2;
      place.half_height = height / 2;
      place.facade = number;
      place.storey = storey;
      place.bay = static_cast<std::uint16_t>(bay);
      place.bays = static_cast<std::uint16_t>(bays);
      place.kind = shops           ? WindowKind::shop
                   : bay == stairs ? WindowKind::stairs
                   : lobby && 6 * bay + 3 >= 2 * bays && 6 * bay + 3 <= 4 * bays ? WindowKind::lobby
                   : use_ == BuildingUse::industrial                             ? WindowKind::hall
                                                                                 : WindowKind::room;
      places_.push_back(place);
    }
  }

  const city::CityObject& building_;
  std::size_t max_windows_, looks_ = 0;
  BuildingUse use_;
  Style style_;
  Random random_;
  std::vector<Facade> facades_;
  double bottom_ = std::numeric_limits<double>::infinity();
  double base_ = 0, first_storey_ = 3, upper_storey_ = 3;
  std::vector<WindowPlace> places_;
};

}  // namespace

std::vector<WindowPlace> place_windows(const city::CityObject& building, BuildingUse use,
                                       std::uint64_t seed, FacadeReport& report,
                                       std::size_t max_windows) {
  return Builder(building, use, seed, max_windows).lay(report);
}

}  // namespace nightcity::lights
