// How much light a road is to have: the classes of EN 13201-2 as horizontal illuminance.
#pragma once

#include <optional>
#include <string_view>

namespace nightcity::layout {

struct LightingClass {
  const char* name;
  double average_lx;  // maintained
  double least_lx;    // P classes: the darkest point; 0 where uniformity rules
  double uniformity;  // C and M classes: least over average; 0 where least_lx rules
};

/// "P1".."P6", "C0".."C5", and "M1".."M6" by the C or P class of comparable level; nothing for another name.
std::optional<LightingClass> lighting_class(std::string_view name);

/// Light left when luminaires are due for cleaning and replacement: what a class asks for must still be
/// there.
constexpr double maintenance_factor = 0.8;

/// A P class may be exceeded by half before it is another class (EN 13201-2, 6).
constexpr double greatest_excess = 1.5;

}  // namespace nightcity::layout
