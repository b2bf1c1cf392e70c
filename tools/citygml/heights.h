// Heights of CityGML 3, which are elements with what they are measured between.
#pragma once

#include <pugixml.hpp>

#include "tools/city/merge_parts.h"

namespace nightcity::citygml {

/// Takes a generic attribute, or those of a set, of which some tell heights (CityGML 1 and 2:
/// gen:doubleAttribute and others; 3: core:genericAttribute). Returns whether it has taken all of
/// them.
bool read_generic(const pugi::xml_node& property, city::NamedHeights& heights);

/// Reads con:height, which holds <con:Height> elements. The greatest value is kept.
void read_height(const pugi::xml_node& property, city::CityObject& object);

/// Elevations of one construction, each a <con:Elevation> with what is there and a position.
class Elevations {
 public:
  /// Reads con:elevation, of which a construction has several.
  void read(const pugi::xml_node& property);
  /// Returns how far the roof lies above the ground, in the unit of the CRS's heights; absent where
  /// one of them is not said or the roof lies below.
  std::optional<double> span() const;

 private:
  // By rank: of several the one of the least rank counts.
  struct Level {
    std::size_t rank = 99;
    double z = 0;
  };
  Level top_, foot_;
};

}  // namespace nightcity::citygml
