#include "tools/cityjson/cityjson_types.h"

#include <unordered_map>

namespace nightcity::cityjson {
namespace {

using R = ObjectRole;
using O = city::ObjectType;
using S = city::SurfaceType;

}  // namespace

ObjectClass find_object_class(std::string_view type) {
  static const std::unordered_map<std::string_view, ObjectClass> table{
      {"Building", {R::top, O::building, S::unknown}},
      {"OtherConstruction", {R::top, O::building, S::unknown}},
      {"Bridge", {R::top, O::bridge, S::unknown}},
      {"Tunnel", {R::top, O::tunnel, S::unknown}},
      {"TINRelief", {R::top, O::relief, S::terrain}},
      {"Road", {R::top, O::road, S::unknown}},
      {"TransportSquare", {R::top, O::road, S::unknown}},
      {"Railway", {R::top, O::railway, S::unknown}},
      {"Waterway", {R::top, O::water, S::water}},
      {"WaterBody", {R::top, O::water, S::water}},
      {"PlantCover", {R::top, O::vegetation, S::unknown}},
      {"SolitaryVegetationObject", {R::top, O::vegetation, S::unknown}},
      {"CityFurniture", {R::top, O::furniture, S::unknown}},
      {"LandUse", {R::top, O::land_use, S::unknown}},
      {"GenericCityObject", {R::top, O::generic, S::unknown}},

      {"BuildingPart", {R::part, O::building, S::unknown}},
      {"BridgePart", {R::part, O::bridge, S::unknown}},
      {"TunnelPart", {R::part, O::tunnel, S::unknown}},

      {"BuildingInstallation", {R::detail, O::building, S::unknown}},
      {"BuildingConstructiveElement", {R::detail, O::building, S::unknown}},
      {"BridgeInstallation", {R::detail, O::bridge, S::unknown}},
      {"BridgeConstructiveElement", {R::detail, O::bridge, S::unknown}},
      {"BridgeConstructionElement", {R::detail, O::bridge, S::unknown}},  // 1.0
      {"TunnelInstallation", {R::detail, O::tunnel, S::unknown}},
      {"TunnelConstructiveElement", {R::detail, O::tunnel, S::unknown}},

      {"BuildingRoom", {R::interior, O::building, S::unknown}},
      {"BuildingStorey", {R::interior, O::building, S::unknown}},
      {"BuildingUnit", {R::interior, O::building, S::unknown}},
      {"BuildingFurniture", {R::interior, O::building, S::unknown}},
      {"BridgeRoom", {R::interior, O::bridge, S::unknown}},
      {"BridgeFurniture", {R::interior, O::bridge, S::unknown}},
      {"TunnelHollowSpace", {R::interior, O::tunnel, S::unknown}},
      {"TunnelFurniture", {R::interior, O::tunnel, S::unknown}},

      {"CityObjectGroup", {R::group, O::other, S::unknown}},
  };
  if (const auto at = table.find(type); at != table.end()) return at->second;
  // Classes of extensions: "+GenericCityObject", which CityJSON 1.1 has no other name for, and
  // those that are called after the class that they extend, such as "+NoiseBuilding".
  if (!type.starts_with('+')) return {};
  for (type.remove_prefix(1); !type.empty(); type.remove_prefix(1))
    if (const auto at = table.find(type); at != table.end()) return at->second;
  return {};
}

std::optional<SurfaceClass> find_surface_class(std::string_view type) {
  static const std::unordered_map<std::string_view, SurfaceClass> table{
      {"WallSurface", {S::wall}},
      {"RoofSurface", {S::roof}},
      {"GroundSurface", {S::ground}},
      {"ClosureSurface", {S::closure}},
      {"OuterCeilingSurface", {S::outer_ceiling}},
      {"OuterFloorSurface", {S::outer_floor}},
      {"Window", {S::window}},
      {"Door", {S::door}},
      {"InteriorWallSurface", {S::unknown, true}},
      {"CeilingSurface", {S::unknown, true}},
      {"FloorSurface", {S::unknown, true}},
      {"WaterSurface", {S::water}},
      {"WaterGroundSurface", {S::ground}},
      {"WaterClosureSurface", {S::closure}},
      {"TrafficArea", {S::traffic_area}},
      {"AuxiliaryTrafficArea", {S::auxiliary_traffic_area}},
      {"TransportationMarking", {S::unknown}},
      {"TransportationHole", {S::unknown}},
  };
  const auto at = table.find(type);
  return at == table.end() ? std::nullopt : std::optional(at->second);
}

std::string_view find_attribute_field(std::string_view name) {
  // CityJSON keeps the names of CityGML's attributes. The Dutch ones are those of 3DBAG, which
  // publishes all buildings of the Netherlands with them and without the others.
  static const std::unordered_map<std::string_view, std::string_view> table{
      {"function", "function"},
      {"usage", "usage"},
      {"class", "class"},
      {"measuredHeight", "measuredheight"},
      {"storeysAboveGround", "storeysaboveground"},
      {"storeyHeightsAboveGround", "storeyheightsaboveground"},
      {"yearOfConstruction", "yearofconstruction"},
      {"dateOfConstruction", "dateofconstruction"},
      {"oorspronkelijkbouwjaar", "yearofconstruction"},
      {"b3_bouwlagen", "storeysaboveground"},
  };
  const auto at = table.find(name);
  return at == table.end() ? std::string_view() : at->second;
}

}  // namespace nightcity::cityjson
