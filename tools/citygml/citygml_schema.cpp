#include "tools/citygml/citygml_schema.h"

#include <string>
#include <unordered_map>

namespace nightcity::citygml {
namespace {

using K = ClassKind;
using O = city::ObjectType;
using S = city::SurfaceType;
using P = PropertyKind;

const std::unordered_map<std::string_view, FeatureClass>& classes() {
  static const std::unordered_map<std::string_view, FeatureClass> table{
      {"Building", {K::top, O::building, S::unknown}},
      {"OtherConstruction", {K::top, O::building, S::unknown}},
      {"Bridge", {K::top, O::bridge, S::unknown}},
      {"Tunnel", {K::top, O::tunnel, S::unknown}},
      {"ReliefFeature", {K::top, O::relief, S::terrain}},
      {"TINRelief", {K::top, O::relief, S::terrain}},
      {"MassPointRelief", {K::top, O::relief, S::terrain}},
      {"BreaklineRelief", {K::top, O::relief, S::terrain}},
      {"RasterRelief", {K::top, O::relief, S::terrain}},
      {"Road", {K::top, O::road, S::unknown}},
      {"Track", {K::top, O::road, S::unknown}},
      {"Square", {K::top, O::road, S::unknown}},
      {"TransportationComplex", {K::top, O::road, S::unknown}},
      {"Railway", {K::top, O::railway, S::unknown}},
      {"WaterBody", {K::top, O::water, S::water}},
      {"Waterway", {K::top, O::water, S::water}},
      {"PlantCover", {K::top, O::vegetation, S::unknown}},
      {"SolitaryVegetationObject", {K::top, O::vegetation, S::unknown}},
      {"CityFurniture", {K::top, O::furniture, S::unknown}},
      {"LandUse", {K::top, O::land_use, S::unknown}},
      {"GenericCityObject", {K::top, O::generic, S::unknown}},
      {"GenericOccupiedSpace", {K::top, O::generic, S::unknown}},
      {"GenericUnoccupiedSpace", {K::top, O::generic, S::unknown}},
      {"GenericLogicalSpace", {K::top, O::generic, S::unknown}},
      {"GenericThematicSurface", {K::top, O::generic, S::unknown}},

      {"BuildingPart", {K::part, O::building, S::unknown}},
      {"BridgePart", {K::part, O::bridge, S::unknown}},
      {"TunnelPart", {K::part, O::tunnel, S::unknown}},

      {"BuildingInstallation", {K::detail, O::building, S::unknown}},
      {"BuildingConstructiveElement", {K::detail, O::building, S::unknown}},
      {"BridgeInstallation", {K::detail, O::bridge, S::unknown}},
      {"BridgeConstructionElement", {K::detail, O::bridge, S::unknown}},
      {"BridgeConstructiveElement", {K::detail, O::bridge, S::unknown}},
      {"TunnelInstallation", {K::detail, O::tunnel, S::unknown}},
      {"TunnelConstructiveElement", {K::detail, O::tunnel, S::unknown}},

      {"WallSurface", {K::surface, O::other, S::wall}},
      {"RoofSurface", {K::surface, O::other, S::roof}},
      {"GroundSurface", {K::surface, O::other, S::ground}},
      {"ClosureSurface", {K::surface, O::other, S::closure}},
      {"OuterCeilingSurface", {K::surface, O::other, S::outer_ceiling}},
      {"OuterFloorSurface", {K::surface, O::other, S::outer_floor}},
      {"Window", {K::surface, O::other, S::window}},
      {"WindowSurface", {K::surface, O::other, S::window}},
      {"Door", {K::surface, O::other, S::door}},
      {"DoorSurface", {K::surface, O::other, S::door}},
      {"TrafficArea", {K::surface, O::road, S::traffic_area}},
      {"AuxiliaryTrafficArea", {K::surface, O::road, S::auxiliary_traffic_area}},
      {"WaterSurface", {K::surface, O::water, S::water}},
      {"WaterGroundSurface", {K::surface, O::water, S::ground}},
      {"WaterClosureSurface", {K::surface, O::water, S::closure}},

      {"Section", {K::passage, O::road, S::unknown}},
      {"Intersection", {K::passage, O::road, S::unknown}},
      {"TrafficSpace", {K::passage, O::road, S::unknown}},
      {"AuxiliaryTrafficSpace", {K::passage, O::road, S::unknown}},
      {"Marking", {K::surface, O::road, S::unknown}},
      {"Hole", {K::passage, O::road, S::unknown}},
      {"HoleSurface", {K::surface, O::road, S::unknown}},
      {"CityObjectGroup", {K::passage, O::other, S::unknown}},

      {"Room", {K::interior, O::building, S::unknown}},
      {"BuildingRoom", {K::interior, O::building, S::unknown}},
      {"BridgeRoom", {K::interior, O::bridge, S::unknown}},
      {"HollowSpace", {K::interior, O::tunnel, S::unknown}},
      {"IntBuildingInstallation", {K::interior, O::building, S::unknown}},
      {"IntBridgeInstallation", {K::interior, O::bridge, S::unknown}},
      {"IntTunnelInstallation", {K::interior, O::tunnel, S::unknown}},
      {"BuildingFurniture", {K::interior, O::building, S::unknown}},
      {"BridgeFurniture", {K::interior, O::bridge, S::unknown}},
      {"TunnelFurniture", {K::interior, O::tunnel, S::unknown}},
      {"InteriorWallSurface", {K::interior, O::building, S::unknown}},
      {"CeilingSurface", {K::interior, O::building, S::unknown}},
      {"FloorSurface", {K::interior, O::building, S::unknown}},
  };
  return table;
}

const std::unordered_map<std::string_view, P>& properties() {
  static const std::unordered_map<std::string_view, P> table{
      {"function", P::attribute},
      {"usage", P::attribute},
      {"class", P::attribute},
      {"measuredHeight", P::attribute},
      {"storeysAboveGround", P::attribute},
      {"storeyHeightsAboveGround", P::attribute},
      {"yearOfConstruction", P::attribute},
      {"dateOfConstruction", P::attribute},

      {"boundedBy", P::features},
      {"boundary", P::features},
      {"opening", P::features},
      {"fillingSurface", P::features},
      {"consistsOfBuildingPart", P::features},
      {"consistsOfBridgePart", P::features},
      {"consistsOfTunnelPart", P::features},
      {"buildingPart", P::features},
      {"bridgePart", P::features},
      {"tunnelPart", P::features},
      {"outerBuildingInstallation", P::features},
      {"buildingInstallation", P::features},
      {"buildingConstructiveElement", P::features},
      {"outerBridgeInstallation", P::features},
      {"bridgeInstallation", P::features},
      {"outerBridgeConstruction", P::features},
      {"bridgeConstructiveElement", P::features},
      {"outerTunnelInstallation", P::features},
      {"tunnelInstallation", P::features},
      {"tunnelConstructiveElement", P::features},
      {"reliefComponent", P::features},
      {"trafficArea", P::features},
      {"auxiliaryTrafficArea", P::features},
      {"trafficSpace", P::features},
      {"auxiliaryTrafficSpace", P::features},
      {"section", P::features},
      {"intersection", P::features},
      {"marking", P::features},
      {"hole", P::features},
      {"groupMember", P::features},
      {"interiorRoom", P::features},
      {"buildingRoom", P::features},
      {"bridgeRoom", P::features},
      {"interiorBridgeRoom", P::features},
      {"interiorHollowSpace", P::features},
      {"hollowSpace", P::features},
      {"interiorBuildingInstallation", P::features},
      {"interiorBridgeInstallation", P::features},
      {"interiorTunnelInstallation", P::features},
      {"interiorFurniture", P::features},
      {"buildingFurniture", P::features},

      {"buildingSubdivision", P::subdivision},

      {"tin", P::geometry},
      {"lod", P::relief_lod},
      {"reliefPoints", P::points},
      {"ridgeOrValleyLines", P::points},
      {"breaklines", P::points},
      {"address", P::address},
      {"appearance", P::appearance},
      {"height", P::height},
      {"elevation", P::elevation},
      {"name", P::name},
      {"description", P::name},
      {"creationDate", P::name},
      {"terminationDate", P::name},
      {"validFrom", P::name},
      {"validTo", P::name},
      {"dateOfDemolition", P::name},
      {"conditionOfConstruction", P::name},
  };
  return table;
}

// Returns whether classes named after this one may stand in its place. Passages
// hold too many unlike things.
bool is_base_class(const FeatureClass& c) {
  return c.kind == K::top || c.kind == K::part || c.kind == K::detail || c.kind == K::interior ||
         (c.kind == K::surface && c.surface != S::unknown);
}

}  // namespace

FeatureClass find_feature_class(std::string_view local) {
  if (const auto at = classes().find(local); at != classes().end()) return at->second;
  // The longest ending that begins with a capital and is a class.
  for (std::size_t i = 1; i < local.size(); ++i) {
    const bool word = local[i] >= 'A' && local[i] <= 'Z' && local[i - 1] >= 'a';
    if (!word) continue;
    const auto at = classes().find(local.substr(i));
    if (at != classes().end() && is_base_class(at->second)) return at->second;
  }
  return {};
}

FeatureClass find_class_at(std::string_view property) {
  if (property.starts_with("interior")) return {K::interior, O::building, S::unknown};
  if (property == "boundedBy" || property == "boundary" || property == "opening" ||
      property == "fillingSurface" || property == "trafficArea" ||
      property == "auxiliaryTrafficArea")
    return {K::surface, O::other, S::unknown};
  if (property.starts_with("consistsOf") || property.ends_with("Part") ||
      property == "buildingSubdivision")
    return {K::part, O::other, S::unknown};
  if (property.ends_with("Installation") || property.ends_with("Construction") ||
      property.ends_with("ConstructiveElement"))
    return {K::detail, O::other, S::unknown};
  return {};
}

int read_lod(std::string_view local) {
  return local.size() > 4 && local.starts_with("lod") && local[3] >= '0' && local[3] <= '4'
             ? local[3] - '0'
             : -1;
}

PropertyKind find_property_kind(std::string_view local) {
  if (read_lod(local) >= 0) return P::geometry;
  const auto at = properties().find(local);
  return at == properties().end() ? P::skip : at->second;
}

}  // namespace nightcity::citygml
