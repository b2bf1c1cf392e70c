#include "tools/ground_cover/painter.h"

#include <utility>

namespace nightcity::ground_cover {

void Painter::add(const char* name, std::vector<glm::dvec2> strip) {
  if (++tried_ == max_markings) ++cover_.left_out["markings beyond the first 4000000"];
  if (is_done() || !bounds_.holds(strip.front())) return;
  ++cover_.markings[name];
  cover_.add_marking(std::move(strip));
}

}  // namespace nightcity::ground_cover
