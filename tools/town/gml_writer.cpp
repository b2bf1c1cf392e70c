#include "tools/town/gml_writer.h"

#include "tools/random.h"
#include "tools/town/building_shape.h"
#include "tools/town/roof_details.h"

namespace nightcity::town {
namespace {

const char* element_of(city::SurfaceType type) {
  switch (type) {
    case city::SurfaceType::roof:
      return "RoofSurface";
    case city::SurfaceType::ground:
      return "GroundSurface";
    default:
      return "WallSurface";
  }
}

/// AdV roof form codes, which German state data use.
int roof_code(const BuildingPlan& plan) {
  if (plan.shape == Shape::apse) return 3600;
  switch (plan.roof) {
    case Roof::flat:
      return 1000;
    case Roof::shed:
      return 2100;
    case Roof::gabled:
      return 3100;
    case Roof::hipped:
      return 3200;
    case Roof::mansard:
      return 3400;
    case Roof::pyramid:
      return 3500;
  }
  return 9999;
}

std::size_t fan_triangles(const city::Polygon& polygon) {
  std::size_t corners = polygon.exterior.size() - 2;
  for (const city::Ring& hole : polygon.interiors)
    corners += hole.size() + 2;  // a bridge there and back
  return corners;
}

}  // namespace

GmlWriter::GmlWriter(TextFile& out, const glm::dvec2& origin, const glm::dvec3& low,
                     const glm::dvec3& high)
    : out_(out), origin_(origin) {
  out_ << R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0")"
       << R"( xmlns:bldg="http://www.opengis.net/citygml/building/2.0")"
       << R"( xmlns:dem="http://www.opengis.net/citygml/relief/2.0")"
       << R"( xmlns:tran="http://www.opengis.net/citygml/transportation/2.0")"
       << R"( xmlns:veg="http://www.opengis.net/citygml/vegetation/2.0")"
       << R"( xmlns:gml="http://www.opengis.net/gml">
<gml:name>Synthetic town</gml:name>
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::25833" srsDimension="3"><gml:lowerCorner>)";
  write_position(low);
  out_ << "</gml:lowerCorner><gml:upperCorner>";
  write_position(high);
  out_ << "</gml:upperCorner></gml:Envelope></gml:boundedBy>\n";
}

void GmlWriter::finish() {
  out_ << "</core:CityModel>\n";
}

void GmlWriter::write_position(const glm::dvec3& p) {
  out_.fixed(p.x + origin_.x, 3) << " ";
  out_.fixed(p.y + origin_.y, 3) << " ";
  out_.fixed(p.z, 3);
}

void GmlWriter::write_ring(const city::Ring& ring) {
  out_ << "<gml:LinearRing><gml:posList srsDimension=\"3\">";
  for (const glm::dvec3& p : ring) {
    write_position(p);
    out_ << " ";
  }
  write_position(ring.front());
  out_ << "</gml:posList></gml:LinearRing>";
}

void GmlWriter::write_relief(const Hills& hills, int x0, int y0, int x1, int y1) {
  const std::string id = "relief_" + std::to_string(x0) + "_" + std::to_string(y0);
  out_ << "<core:cityObjectMember><dem:ReliefFeature gml:id=\"" << id
       << "\"><dem:lod>2</dem:lod><dem:reliefComponent><dem:TINRelief gml:id=\"" << id
       << "_tin\"><dem:lod>2</dem:lod><dem:tin><gml:TriangulatedSurface><gml:trianglePatches>\n";
  const auto corner = [&](int x, int y) {
    const glm::dvec2 p(x * Hills::spacing_m, y * Hills::spacing_m);
    return glm::dvec3(p, hills.smooth(p));
  };
  const auto triangle = [&](const city::Ring& corners) {
    out_ << "<gml:Triangle><gml:exterior>";
    write_ring(corners);
    out_ << "</gml:exterior></gml:Triangle>\n";
    ++counts_.polygons;
    ++counts_.triangles;
  };
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {  // cut as in Hills::height
      triangle({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)});
      triangle({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)});
    }
  out_ << "</gml:trianglePatches></gml:TriangulatedSurface></dem:tin></dem:TINRelief></"
          "dem:reliefComponent>"
          "</dem:ReliefFeature></core:cityObjectMember>\n";
}

void GmlWriter::write_road(const RoadPlan& road) {
  const std::string id = std::string(road.kind) + "_" + std::to_string(road.axis) + "_" +
                         std::to_string(road.i) + "_" + std::to_string(road.j);
  out_ << "<core:cityObjectMember><tran:Road gml:id=\"" << id
       << "\"><tran:class>1040</tran:class>\n";
  for (const RoadArea& area : road.areas) {
    out_ << "<tran:trafficArea><tran:TrafficArea><tran:function>" << area.function
         << "</tran:function><tran:lod2MultiSurface><gml:MultiSurface>\n";
    for (const city::Ring& corners : area.rings) {
      city::Polygon surface;
      surface.exterior = corners;
      write_polygon(surface, "");
      out_ << "\n";
    }
    out_ << "</gml:MultiSurface></tran:lod2MultiSurface></tran:TrafficArea></tran:trafficArea>\n";
  }
  out_ << "</tran:Road></core:cityObjectMember>\n";
  ++counts_.streets;
}

void GmlWriter::write_polygon(const city::Polygon& polygon, const std::string& id) {
  out_ << "<gml:surfaceMember><gml:Polygon";
  if (!id.empty()) out_ << " gml:id=\"" << id << "\"";
  out_ << "><gml:exterior>";
  write_ring(polygon.exterior);
  out_ << "</gml:exterior>";
  for (const city::Ring& hole : polygon.interiors) {
    out_ << "<gml:interior>";
    write_ring(hole);
    out_ << "</gml:interior>";
  }
  out_ << "</gml:Polygon></gml:surfaceMember>";
  ++counts_.polygons;
  counts_.triangles += fan_triangles(polygon);
}

void GmlWriter::write_surface(const std::string& id, const city::Polygon& surface) {
  const char* element = element_of(surface.surface);
  out_ << "<bldg:boundedBy><bldg:" << element << " gml:id=\"" << id
       << "\"><bldg:lod2MultiSurface><gml:MultiSurface>";
  write_polygon(surface, id + "_poly");
  out_ << "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:" << element << "></bldg:boundedBy>\n";
}

void GmlWriter::write_details(const BuildingPlan& plan, const std::string& id, std::uint64_t seed) {
  std::size_t number = 0;
  for (const RoofDetail& detail : make_roof_details(plan, seed, counts_.buildings)) {
    out_ << "<bldg:outerBuildingInstallation><bldg:BuildingInstallation gml:id=\"" << id
         << "_on_roof_" << number++ << "\"><bldg:function>" << (detail.chimney ? "1030" : "1070")
         << "</bldg:function><bldg:lod2Geometry><gml:MultiSurface>\n";
    for (const city::Polygon& surface : detail.surfaces) {
      write_polygon(surface, "");
      out_ << "\n";
    }
    out_ << "</gml:MultiSurface></bldg:lod2Geometry></bldg:BuildingInstallation></"
            "bldg:outerBuildingInstallation>\n";
  }
}

void GmlWriter::write_tree(const TreePlan& tree) {
  out_ << "<core:cityObjectMember><veg:SolitaryVegetationObject gml:id=\"tree_" << counts_.trees
       << "\"><veg:class>1070</veg:class><veg:height uom=\"m\">";
  out_.fixed(tree.height_m, 2) << "</veg:height><veg:crownDiameter uom=\"m\">";
  out_.fixed(2 * tree.crown_radius_m, 2)
      << "</veg:crownDiameter><veg:lod2Geometry><gml:MultiSurface>\n";
  for (city::Ring& corners : make_tree_surfaces(tree)) {
    city::Polygon surface;
    surface.exterior = std::move(corners);
    write_polygon(surface, "");
    out_ << "\n";
  }
  out_ << "</gml:MultiSurface></veg:lod2Geometry></veg:SolitaryVegetationObject></"
          "core:cityObjectMember>\n";
  ++counts_.trees;
}

void GmlWriter::write_attributes(const BuildingPlan& plan, std::uint64_t seed) {
  // Real registers have gaps filled with sentinels: a reader has to take 9999 for "unknown".
  Random random{static_cast<std::int64_t>(seed), 10, static_cast<std::int64_t>(counts_.buildings)};
  out_ << "<bldg:function>" << plan.function << "</bldg:function>\n";
  if (random.chance(0.7))
    out_ << "<bldg:yearOfConstruction>" << plan.year << "</bldg:yearOfConstruction>\n";
  out_ << "<bldg:roofType>" << roof_code(plan) << "</bldg:roofType>\n";
  if (random.chance(0.97)) {
    out_ << "<bldg:measuredHeight uom=\"m\">";
    out_.fixed(std::max(plan.eave_m, plan.ridge_m) - plan.ground_m, 3)
        << "</bldg:measuredHeight>\n";
  }
  const double pick = random.uniform();
  if (pick < 0.80)
    out_ << "<bldg:storeysAboveGround>" << plan.storeys << "</bldg:storeysAboveGround>\n";
  else if (pick < 0.86)
    out_ << "<bldg:storeysAboveGround>9999</bldg:storeysAboveGround>\n";
}

void GmlWriter::write_body(const BuildingPlan& plan, const std::string& id) {
  std::size_t number = 0;
  for (const city::Polygon& polygon : make_surfaces(plan))
    write_surface(id + "_" + std::to_string(number++), polygon);
}

void GmlWriter::write_building(const BuildingPlan& plan, std::uint64_t seed) {
  const std::string id = "house_" + std::to_string(counts_.buildings);
  out_ << "<core:cityObjectMember><bldg:Building gml:id=\"" << id << "\">\n";
  write_attributes(plan, seed);
  write_details(plan, id, seed);
  write_body(plan, id);
  for (std::size_t n = 0; n < plan.parts.size(); ++n) {
    const std::string part = id + "_part_" + std::to_string(n);
    out_ << "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"" << part
         << "\">\n<bldg:roofType>" << roof_code(plan.parts[n]) << "</bldg:roofType>\n";
    write_body(plan.parts[n], part);
    out_ << "</bldg:BuildingPart></bldg:consistsOfBuildingPart>\n";
  }
  out_ << "</bldg:Building></core:cityObjectMember>\n";
  ++counts_.buildings;
}

}  // namespace nightcity::town
