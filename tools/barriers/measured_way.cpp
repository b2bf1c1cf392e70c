#include "tools/barriers/measured_way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/finite.h"

namespace nightcity::barriers {
namespace {

using Span = std::pair<double, double>;

std::vector<Span> join_spans(std::vector<Span> spans) {
  std::sort(spans.begin(), spans.end());
  std::vector<Span> joined;
  for (const Span& span : spans)
    if (!joined.empty() && span.first <= joined.back().second)
      joined.back().second = std::max(joined.back().second, span.second);
    else
      joined.push_back(span);
  return joined;
}

// Returns the first of some spans, in order, that ends beyond a place.
auto find_span(const std::vector<Span>& spans, double s_m) {
  return std::upper_bound(spans.begin(), spans.end(), s_m,
                          [](double s, const Span& span) { return s < span.second; });
}

}  // namespace

bool MeasuredWay::is_open_at(double s_m) const {
  const auto next = find_span(openings_m, s_m);
  return next != openings_m.end() && next->first < s_m;
}

std::vector<double> MeasuredWay::find_cuts(std::size_t segment, double from_m, double to_m,
                                           double step_m) const {
  const double start_m = at_m[segment], steps = std::ceil((to_m - from_m) / step_m);
  std::vector<double> cuts;
  for (double k = 0; k < steps; ++k) cuts.push_back(from_m + (to_m - from_m) * (k / steps));
  cuts.push_back(to_m);
  for (auto next = find_span(openings_m, start_m + from_m);
       next != openings_m.end() && next->first < start_m + to_m; ++next)
    for (const double s : {next->first - start_m, next->second - start_m})
      if (s > from_m && s < to_m) cuts.push_back(s);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

MeasuredWay measure(const osm::OsmWay& way, const place::LonLatToFrame& to_frame,
                    const Openings& openings, double thickness_m) {
  MeasuredWay line;
  std::vector<glm::dvec2> nodes;  // of the points
  for (const glm::dvec2& lon_lat : way.lon_lat) {
    const glm::dvec2 p = to_frame(lon_lat);
    if (!finite(p)) continue;
    const double s =
        line.points.empty() ? 0 : line.at_m.back() + glm::distance(line.points.back(), p);
    line.points.push_back(p);
    line.at_m.push_back(s);
    nodes.push_back(lon_lat);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double length_m = openings.width_at(nodes[i]);
    if (!(length_m > 0)) continue;
    for (const std::size_t first : {i - 1, i}) {  // of the segments that meet there
      if (first >= nodes.size() - 1) continue;    // beyond an end
      const glm::dvec2 along = line.points[first + 1] - line.points[first];
      if (const double m = glm::length(along); m > 0)
        length_m =
            std::max(length_m, openings.length_along(nodes[i], along / m, thickness_m, to_frame));
    }
    line.openings_m.emplace_back(line.at_m[i] - length_m / 2, line.at_m[i] + length_m / 2);
  }
  line.openings_m = join_spans(std::move(line.openings_m));
  return line;
}

}  // namespace nightcity::barriers
