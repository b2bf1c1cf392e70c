// The smallest city with everything in it: a cube, a ground of two triangles, a lamp beside a road.
#pragma once

#include <filesystem>
#include <string>

#include "support/process.h"
#include "support/temp_folder.h"

namespace nightcity::test {

/// Runs nightbake.
inline Outcome nightbake(const std::string& arguments) {
  return run_program("nightbake", arguments);
}

/// Returns a cube of 10 m on a 60 m square of terrain at 35 m, EPSG:25833, about (391020, 5819010).
inline std::string sample_gml() {
  const auto polygon = [](const std::string& positions) {
    return "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList "
           "srsDimension=\"3\">" +
           positions +
           "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
  };
  const auto surface = [&polygon](const std::string& type, const std::string& positions) {
    return "<bldg:boundedBy><bldg:" + type + "><bldg:lod2MultiSurface><gml:MultiSurface>" +
           polygon(positions) + "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:" + type +
           "></bldg:boundedBy>";
  };
  const auto corner = [](int east, int north, int height) {
    return std::to_string(391000 + east) + " " + std::to_string(5819000 + north) + " " +
           std::to_string(height) + " ";
  };
  const auto quad = [&corner](const int(&c)[4][3]) {
    std::string text;
    for (const int i : {0, 1, 2, 3, 0}) text += corner(c[i][0], c[i][1], c[i][2]);
    return text;
  };
  const auto triangle = [&corner](const int(&c)[3][2]) {
    std::string text;
    for (const int i : {0, 1, 2, 0}) text += corner(c[i][0], c[i][1], 35);
    return "<gml:Triangle><gml:exterior><gml:LinearRing><gml:posList srsDimension=\"3\">" + text +
           "</gml:posList></gml:LinearRing></gml:exterior></gml:Triangle>";
  };
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
  xmlns:dem="http://www.opengis.net/citygml/relief/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::25833" srsDimension="3"><gml:lowerCorner>390990 5818980 35</gml:lowerCorner><gml:upperCorner>391050 5819040 45</gml:upperCorner></gml:Envelope></gml:boundedBy>
<core:cityObjectMember><bldg:Building gml:id="cube"><bldg:function>31001_1000</bldg:function><bldg:measuredHeight uom="m">10</bldg:measuredHeight>)" +
         surface("GroundSurface", quad({{0, 0, 35}, {0, 10, 35}, {10, 10, 35}, {10, 0, 35}})) +
         surface("RoofSurface", quad({{0, 0, 45}, {10, 0, 45}, {10, 10, 45}, {0, 10, 45}})) +
         surface("WallSurface", quad({{0, 0, 35}, {10, 0, 35}, {10, 0, 45}, {0, 0, 45}})) +
         surface("WallSurface", quad({{10, 0, 35}, {10, 10, 35}, {10, 10, 45}, {10, 0, 45}})) +
         surface("WallSurface", quad({{10, 10, 35}, {0, 10, 35}, {0, 10, 45}, {10, 10, 45}})) +
         surface("WallSurface", quad({{0, 10, 35}, {0, 0, 35}, {0, 0, 45}, {0, 10, 45}})) +
         R"(</bldg:Building></core:cityObjectMember>
<core:cityObjectMember><dem:ReliefFeature gml:id="relief"><dem:lod>2</dem:lod><dem:reliefComponent><dem:TINRelief gml:id="tin"><dem:lod>2</dem:lod><dem:tin><gml:TriangulatedSurface><gml:trianglePatches>)" +
         triangle({{-10, -20}, {50, -20}, {50, 40}}) + triangle({{-10, -20}, {50, 40}, {-10, 40}}) +
         R"(</gml:trianglePatches></gml:TriangulatedSurface></dem:tin></dem:TINRelief></dem:reliefComponent></dem:ReliefFeature></core:cityObjectMember>
</core:CityModel>
)";
}

/// Returns a map with one lamp at (391020, 5819010), one far away, and a residential street 4 m
/// east of the first.
inline std::string sample_osm() {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<osm version="0.6">
<node id="1" lat="52.510303463" lon="13.394162598"><tag k="highway" v="street_lamp"/></node>
<node id="2" lat="52.6" lon="13.5"><tag k="highway" v="street_lamp"/></node>
<node id="3" lat="52.5102" lon="13.39422"/><node id="4" lat="52.5104" lon="13.39422"/>
<way id="5"><nd ref="3"/><nd ref="4"/><tag k="highway" v="residential"/></way>
</osm>
)";
}

/// Writes city.gml, map.osm, recipe.toml and mapped.toml (the map's lamps and no other light) into
/// `folder`, and returns the path of recipe.toml.
inline std::filesystem::path write_sample(const TempFolder& folder) {
  write_text(folder / "city.gml", sample_gml());
  write_text(folder / "map.osm", sample_osm());
  write_text(folder / "recipe.toml",
             "[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"map.osm\"]\n");
  write_text(
      folder / "mapped.toml",
      "[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"map.osm\"]\n[lamps]\nlayout = \"never\"\n"
      "[windows]\nlit = false\n");
  return folder / "recipe.toml";
}

}  // namespace nightcity::test
