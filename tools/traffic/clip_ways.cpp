#include "tools/traffic/clip_ways.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/place/between.h"

namespace nightcity::traffic {
namespace {

constexpr double longest_jump_m = 1e5;  // a longer jump between two nodes is a broken extract

class Clipper {
 public:
  Clipper(const osm::OsmWay& way, const place::LonLatToFrame& to_frame,
          const place::HeightAt& height_at, ClippedWays& result)
      : way_(way), to_frame_(to_frame), height_at_(height_at), result_(result) {}

  void run(double step_m) {
    for (std::size_t n = 0; n < way_.lon_lat.size(); ++n) {
      const glm::dvec2 next = way_.lon_lat[n];
      const bool next_in = ground(next);
      if (n > 0) cross(way_.lon_lat[n - 1], next, step_m);
      if (!next_in)
        finish();
      else
        part_.push_back(next);
    }
    finish();
  }

 private:
  bool ground_at(const glm::dvec2& p) const {
    return std::isfinite(p.x) && std::isfinite(p.y) && height_at_(p);
  }
  bool ground(const glm::dvec2& lon_lat) const { return ground_at(to_frame_(lon_lat)); }

  /// Finds where the ground begins and ends between two nodes, without the nodes themselves.
  void cross(const glm::dvec2& a, const glm::dvec2& b, double step_m) {
    const glm::dvec2 pa = to_frame_(a), pb = to_frame_(b);
    const double length = glm::distance(pa, pb);
    if (!(length < longest_jump_m)) {  // or not finite
      finish();
      return;
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(length / step_m)));
    double at = 0;
    bool in = ground_at(pa);
    for (int k = 1; k <= steps; ++k) {
      const double next = static_cast<double>(k) / steps;
      const bool next_in = ground_at(glm::mix(pa, pb, next));
      if (next_in != in) {
        cut(in ? border(a, b, at, next) : border(a, b, next, at), !in);
        in = next_in;
      }
      at = next;
    }
  }

  /// Returns the last place with ground on the way from a share of the line that has ground to one
  /// that has none.
  glm::dvec2 border(const glm::dvec2& a, const glm::dvec2& b, double in, double out) const {
    const glm::dvec2 pa = to_frame_(a), pb = to_frame_(b);
    for (int k = 0; k < 12; ++k) {
      const double middle = (in + out) / 2;
      (ground_at(glm::mix(pa, pb, middle)) ? in : out) = middle;
    }
    // Degrees are rounded, perhaps to the far side of the border.
    const glm::dvec2 place = place::find_between(a, b, in, to_frame_);
    return ground(place) ? place : place::find_between(a, b, in - (out - in), to_frame_);
  }

  void cut(const glm::dvec2& place, bool begins) {
    result_.cuts.insert(osm_units(place));
    part_.push_back(place);
    if (!begins) finish();
  }

  void finish() {
    if (part_.size() > 1) result_.ways.push_back({way_.id, part_, way_.tags});
    part_.clear();
  }

  const osm::OsmWay& way_;
  const place::LonLatToFrame& to_frame_;
  const place::HeightAt& height_at_;
  ClippedWays& result_;
  std::vector<glm::dvec2> part_;
};

}  // namespace

std::pair<std::int64_t, std::int64_t> osm_units(const glm::dvec2& lon_lat) {
  return {std::llround(lon_lat.x * 1e7), std::llround(lon_lat.y * 1e7)};
}

void clip_way(const osm::OsmWay& way, const place::LonLatToFrame& to_frame,
              const place::HeightAt& height_at, double step_m, ClippedWays& result) {
  Clipper(way, to_frame, height_at, result).run(step_m);
}

}  // namespace nightcity::traffic
