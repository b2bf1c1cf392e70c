// The element names of CityGML 1.0, 2.0 and 3.0 and what each stands for in our model.
#pragma once

#include <cstdint>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity::citygml {

/// The role that a feature class plays in its parent.
enum class ClassKind : std::uint8_t {
  top,      // a city object of its own; inside another of its kind, a part of that
  part,     // BuildingPart, BridgePart, ...: a space of its own
  detail,   // installations and construction elements: they add to their parent
  surface,  // thematic surfaces, openings
  /// Holds features, without geometry of a kind of its own: Section, TrafficSpace, ReliefFeature's
  /// components.
  passage,
  interior,  // rooms, furniture, inner walls: neither lights nor cameras get in
  unknown,
};

struct FeatureClass {
  ClassKind kind = ClassKind::unknown;
  city::ObjectType object = city::ObjectType::other;
  city::SurfaceType surface = city::SurfaceType::unknown;
};

/// Returns the class of an element by its name without prefix. An application domain extension
/// (ADE) derives its classes from those of CityGML (CityGML 2.0, 10.13), and names them after
/// these: "UndergroundBuilding" is taken for a Building, "GreenRoofSurface" for a RoofSurface.
FeatureClass find_feature_class(std::string_view local);

/// Returns the class that a feature of unknown name must have at a property (name without prefix):
/// a surface in boundedBy, a part in consistsOfBuildingPart, ... Unknown where the property says
/// nothing.
FeatureClass find_class_at(std::string_view property);

/// Selects the way in which a property of a feature is read.
enum class PropertyKind : std::uint8_t {
  skip,       // not used: counted by name
  attribute,  // function, usage, measuredHeight, ...
  features,   // holds child features
  geometry,   // lodN..., tin
  /// Holds storeys or units of a building, which may have the geometry that it lacks.
  subdivision,
  relief_lod,  // dem:lod
  points,      // mass points, break lines
  address,
  appearance,
  height,     // CityGML 3's con:height
  elevation,  // con:elevation
  /// gml:name, gml:description, dates (those of end_date.h included): not worth a count.
  name,
};
PropertyKind find_property_kind(std::string_view local);

/// Returns the N of "lodN...", -1 where there is none.
int read_lod(std::string_view local);

}  // namespace nightcity::citygml
