#include "tools/ground_cover/painter.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace nightcity::ground_cover {

void Painter::add(const char* name, std::vector<glm::dvec2> strip) {
  if (++tried_ == max_markings) ++cover_.left_out["markings beyond the first 4000000"];
  if (is_done() || !bounds_.holds(strip.front())) return;
  ++cover_.markings[name];
  cover_.add_marking(std::move(strip));
}

MeasuredLine::MeasuredLine(const std::vector<glm::dvec2>& line) : line_(line), at_m_{0} {
  for (std::size_t i = 1; i < line.size(); ++i)
    at_m_.push_back(at_m_.back() + glm::distance(line[i - 1], line[i]));
}

std::vector<glm::dvec2> MeasuredLine::make_strip(double from_m, double to_m, double right_m,
                                                 double left_m) const {
  const auto [a, along_a] = find(from_m);
  const auto [b, along_b] = find(to_m);
  const glm::dvec2 left_a(-along_a.y, along_a.x), left_b(-along_b.y, along_b.x);
  return {a + left_a * right_m, b + left_b * right_m, b + left_b * left_m, a + left_a * left_m};
}

// Returns a place and the direction of the line there.
std::pair<glm::dvec2, glm::dvec2> MeasuredLine::find(double s) const {
  const auto next = std::lower_bound(at_m_.begin() + 1, at_m_.end() - 1, s);
  const auto i = static_cast<std::size_t>(next - at_m_.begin());
  const double length = at_m_[i] - at_m_[i - 1];
  if (!(length > 0)) return {line_[i], {1, 0}};
  const glm::dvec2 along = (line_[i] - line_[i - 1]) / length;
  return {line_[i - 1] + along * (s - at_m_[i - 1]), along};
}

void Junctions::add(const osm::OsmWay& way) {
  for (std::size_t i = 0; i < way.lon_lat.size(); ++i) {
    const bool at_end = i == 0 || i + 1 == way.lon_lat.size();
    arms_[{way.lon_lat[i].x, way.lon_lat[i].y}] += at_end ? 1 : 2;
  }
}

bool Junctions::holds(const glm::dvec2& lon_lat) const {
  const auto found = arms_.find({lon_lat.x, lon_lat.y});
  return found != arms_.end() && found->second > 2;
}

bool is_drivable(const std::optional<roads::Carriageway>& road) {
  return road && road->lanes[0] + road->lanes[1] > 0;
}

}  // namespace nightcity::ground_cover
