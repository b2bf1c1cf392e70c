#include "tools/ground_cover/way_line.h"

#include <algorithm>

#include "formats/finite.h"

namespace nightcity::ground_cover {

std::vector<glm::dvec2> find_line(const std::vector<glm::dvec2>& lon_lat,
                                  const place::LonLatToFrame& to_frame, const Box& bounds) {
  std::vector<glm::dvec2> line;
  for (const glm::dvec2& p : lon_lat)
    if (const glm::dvec2 place = to_frame(p); finite(place)) line.push_back(place);
  if (line.empty()) return {};
  const Box box = find_box({line});
  const bool meets = box.high.x >= bounds.low.x && box.low.x <= bounds.high.x &&
                     box.high.y >= bounds.low.y && box.low.y <= bounds.high.y;
  return meets ? line : std::vector<glm::dvec2>();
}

}  // namespace nightcity::ground_cover
