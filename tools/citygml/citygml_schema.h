// What the element names of CityGML 1.0, 2.0 and 3.0 mean to us, by local name.
#pragma once

#include <cstdint>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity {

/// How a feature class stands in its parent.
enum class ClassKind : std::uint8_t {
  top,      // a city object of its own; inside another of its kind it is a part of it
  part,     // BuildingPart, BridgePart, ...: a space of its own
  detail,   // installations and construction elements: they add to their parent
  surface,  // thematic surfaces, openings
  passage,  // holds features, has no geometry of its own kind: Section, TrafficSpace, ReliefFeature's
            // components
  interior,  // rooms, furniture, inner walls: no light or eye of ours gets in
  unknown,
};

struct FeatureClass {
  ClassKind kind = ClassKind::unknown;
  ObjectType object = ObjectType::other;
  SurfaceType surface = SurfaceType::unknown;
};

/// `local`: element name without prefix.
FeatureClass feature_class(std::string_view local);

/// How a property of a feature is to be read.
enum class PropertyKind : std::uint8_t {
  skip,        // not used: counted by name
  attribute,   // function, usage, measuredHeight, ...
  features,    // holds child features
  geometry,    // lodN..., tin
  relief_lod,  // dem:lod
  points,      // mass points, break lines
  address,
  appearance,
  height,  // CityGML 3's con:height
  name,  // gml:name, gml:description, creationDate: metadata a light layout has no use for, not worth a count
};
PropertyKind property_kind(std::string_view local);

/// The N of "lodN...", -1 where there is none.
int lod_in(std::string_view local);

}  // namespace nightcity
