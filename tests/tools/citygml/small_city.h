// CityGML text for tests.
#pragma once

#include <string>

namespace nightcity::test {

inline std::string city_model(const std::string& members, const std::string& version = "2.0") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/" +
         version + "\" xmlns:bldg=\"http://www.opengis.net/citygml/building/" + version +
         "\" xmlns:gml=\"http://www.opengis.net/gml\" xmlns:xlink=\"http://www.w3.org/1999/xlink\""
         " xmlns:app=\"http://www.opengis.net/citygml/appearance/" +
         version + "\" xmlns:dem=\"http://www.opengis.net/citygml/relief/" + version +
         "\" xmlns:tran=\"http://www.opengis.net/citygml/transportation/" + version +
         "\" xmlns:frn=\"http://www.opengis.net/citygml/cityfurniture/" + version +
         "\" xmlns:gen=\"http://www.opengis.net/citygml/generics/" + version +
         "\">\n"
         "<gml:boundedBy><gml:Envelope srsName=\"EPSG:25833\"><gml:lowerCorner>0 0 "
         "0</gml:lowerCorner>"
         "<gml:upperCorner>9 9 9</gml:upperCorner></gml:Envelope></gml:boundedBy>\n" +
         members + "</core:CityModel>\n";
}

inline std::string member(const std::string& object) {
  return "<core:cityObjectMember>" + object + "</core:cityObjectMember>\n";
}

inline std::string ring(const std::string& pos_list) {
  return "<gml:LinearRing><gml:posList srsDimension=\"3\">" + pos_list +
         "</gml:posList></gml:LinearRing>";
}

inline std::string polygon(const std::string& id, const std::string& pos_list) {
  return "<gml:Polygon" + (id.empty() ? "" : " gml:id=\"" + id + "\"") + "><gml:exterior>" +
         ring(pos_list) + "</gml:exterior></gml:Polygon>";
}

inline std::string surface_member(const std::string& polygon) {
  return "<gml:surfaceMember>" + polygon + "</gml:surfaceMember>";
}

inline std::string xlink_member(const std::string& id) {
  return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>";
}

inline std::string multi_surface(const std::string& members) {
  return "<gml:MultiSurface>" + members + "</gml:MultiSurface>";
}

inline std::string boundary(const std::string& type, const std::string& members, int lod = 2) {
  const std::string n = std::to_string(lod);
  return "<bldg:boundedBy><bldg:" + type + "><bldg:lod" + n + "MultiSurface>" +
         multi_surface(members) + "</bldg:lod" + n + "MultiSurface></bldg:" + type +
         "></bldg:boundedBy>";
}

inline const char* square_at_zero = "0 0 0 0 1 0 1 1 0 1 0 0 0 0 0";  // faces down
inline const char* square_at_one = "0 0 1 1 0 1 1 1 1 0 1 1 0 0 1";   // faces up
inline const char* south_wall = "0 0 0 1 0 0 1 0 1 0 0 1 0 0 0";

/// A unit box with ground, roof, one wall and a solid that refers to all of them.
inline std::string building(const std::string& id, const std::string& attributes = "") {
  return "<bldg:Building gml:id=\"" + id + "\">" + attributes +
         "<bldg:lod2Solid><gml:Solid><gml:exterior>" + "<gml:CompositeSurface>" +
         xlink_member(id + "_g") + xlink_member(id + "_r") + xlink_member(id + "_w") +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>" +
         boundary("GroundSurface", surface_member(polygon(id + "_g", square_at_zero))) +
         boundary("RoofSurface", surface_member(polygon(id + "_r", square_at_one))) +
         boundary("WallSurface", surface_member(polygon(id + "_w", south_wall))) +
         "</bldg:Building>";
}

}  // namespace nightcity::test
