#include "tools/town/osm_elements.h"

#include <GeographicLib/UTMUPS.hpp>

namespace nightcity::town {

OsmElements& OsmElements::open_node(std::int64_t id, const glm::dvec2& p) {
  double latitude, longitude;
  GeographicLib::UTMUPS::Reverse(33, true, p.x + options_.origin_east_m,
                                 p.y + options_.origin_north_m, latitude, longitude);
  out_ << "<node id=\"" << id << "\" version=\"1\" lat=\"";
  out_.fixed(latitude, 7) << "\" lon=\"";
  out_.fixed(longitude, 7) << "\"";
  return *this;
}

void OsmElements::tag(std::string_view key, std::string_view value) {
  out_ << "<tag k=\"" << key << "\" v=\"" << value << "\"/>\n";
}

}  // namespace nightcity::town
