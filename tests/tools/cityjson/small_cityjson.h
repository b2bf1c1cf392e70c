// CityJSON text for tests.
#pragma once

#include <string>

namespace nightcity::test {

/// A cube of 2 x 3 x 4 m with its corner at 10, 20, 30: vertices in steps of a centimetre.
inline const char* box_vertices =
    "[[0,0,0],[200,0,0],[200,300,0],[0,300,0],[0,0,400],[200,0,400],[200,300,400],[0,300,400]]";
inline const char* transform =
    "\"transform\":{\"scale\":[0.01,0.01,0.01],\"translate\":[10,20,30]}";
/// Its six faces, turned outward: ground, roof, walls.
inline const char* box_faces =
    "[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]";

inline std::string box_semantics(const std::string& values = "[[0,1,2,2,2,2]]") {
  return "\"semantics\":{\"surfaces\":[{\"type\":\"GroundSurface\"},{\"type\":\"RoofSurface\"},"
         "{\"type\":\"WallSurface\"}],\"values\":" +
         values + "}";
}

inline std::string solid(const std::string& lod = "\"2.2\"", const std::string& more = "") {
  return "{\"type\":\"Solid\",\"lod\":" + lod + ",\"boundaries\":[[" + std::string(box_faces) +
         "]]" + (more.empty() ? "" : ",") + more + "}";
}

inline std::string object(const std::string& id, const std::string& type,
                          const std::string& geometries, const std::string& more = "") {
  return "\"" + id + "\":{\"type\":\"" + type + "\"" + (more.empty() ? "" : ",") + more +
         ",\"geometry\":[" + geometries + "]}";
}

inline std::string city_json(const std::string& objects, const std::string& more = "",
                             const std::string& version = "2.0") {
  return "{\"type\":\"CityJSON\",\"version\":\"" + version + "\"," + transform +
         ",\"metadata\":{\"referenceSystem\":\"https://www.opengis.net/def/crs/EPSG/0/7415\"}" +
         (more.empty() ? "" : ",") + more + ",\"CityObjects\":{" + objects +
         "},\"vertices\":" + box_vertices + "}";
}

inline std::string header(const std::string& more = "") {
  return std::string("{\"type\":\"CityJSON\",\"version\":\"2.0\",") + transform +
         ",\"metadata\":{\"referenceSystem\":\"https://www.opengis.net/def/crs/EPSG/0/7415\"}" +
         (more.empty() ? "" : ",") + more + ",\"CityObjects\":{},\"vertices\":[]}\n";
}

inline std::string feature(const std::string& id, const std::string& objects,
                           const std::string& more = "") {
  return "{\"type\":\"CityJSONFeature\",\"id\":\"" + id + "\",\"CityObjects\":{" + objects +
         "},\"vertices\":" + box_vertices + (more.empty() ? "" : ",") + more + "}\n";
}

}  // namespace nightcity::test
