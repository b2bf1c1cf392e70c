#include "tools/lights/tm33_opening.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "tools/lights/tm33_xml.h"

namespace nightcity::lights {
namespace {

// TM-33 counts in millimetres.
constexpr double mm_in_m = 1000;
constexpr std::array<std::pair<const char*, const char*>, 3> axis_names{
    {{"Length", "LengthOffset"}, {"Width", "WidthOffset"}, {"Height", "HeightOffset"}}};

}  // namespace

double Tm33Opening::read(const pugi::xml_node& parent, const char* name) const {
  const pugi::xml_node node = find_child(parent, name);
  if (!node) return 0;
  const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, node.offset_debug()));
  return lines_.number(city::trim(node.text().get()), lines_.find_line(at), name) / mm_in_m;
}

void Tm33Opening::add(const pugi::xml_node& emitter) {
  const pugi::xml_node centre = find_child(emitter, "EmitterCenter");
  const std::array<double, 3> at{read(centre, axis_names[0].second),
                                 read(centre, axis_names[1].second),
                                 read(centre, axis_names[2].second)};
  for (const pugi::xml_node& face : find_child(emitter, "EmissionAreas").children())
    for (const pugi::xml_node& area : face.children())
      if (local_name(area).ends_with("Area")) add_area(area, at);
}

void Tm33Opening::add_area(const pugi::xml_node& area, const std::array<double, 3>& centre) {
  for (std::size_t n = 0; n < axes_.size(); ++n) {
    const auto [size_name, place_name] = axis_names[n];
    if (!find_child(area, size_name)) continue;  // the area lies across this axis
    const double half = std::abs(read(area, size_name)) / 2,
                 at = centre[n] + read(area, place_name);
    Axis& axis = axes_[n];
    axis.low = axis.known ? std::min(axis.low, at - half) : at - half;
    axis.high = axis.known ? std::max(axis.high, at + half) : at + half;
    axis.known = true;
  }
}

void Tm33Opening::give(Luminaire& luminaire) const {
  luminaire.length_m = axes_[0].high - axes_[0].low;
  luminaire.width_m = axes_[1].high - axes_[1].low;
  luminaire.height_m = axes_[2].high - axes_[2].low;
}

}  // namespace nightcity::lights
