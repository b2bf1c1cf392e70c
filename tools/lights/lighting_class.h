// The lighting classes of EN 13201-2 as horizontal illuminance.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace nightcity::lights {

struct LightingClass {
  const char* name;
  double average_lx;  // maintained
  double min_lx;      // P classes: the darkest point; 0 where uniformity rules
  double uniformity;  // C and M classes: least over average; 0 where min_lx rules
};

// EN 13201-2:2015, tables 2 (C) and 3 (P). The M classes are luminances (2, 1.5, 1, 0.75, 0.5, 0.3
// cd/m2); their rows hold the illuminance class of comparable level in CEN/TR 13201-1:2014 (M1 to
// M5: C1 to C5, M6: P4).
constexpr std::array<LightingClass, 18> en13201_classes = {{
    {"P1", 15, 3, 0},
    {"P2", 10, 2, 0},
    {"P3", 7.5, 1.5, 0},
    {"P4", 5, 1, 0},
    {"P5", 3, 0.6, 0},
    {"P6", 2, 0.4, 0},
    {"C0", 50, 0, 0.4},
    {"C1", 30, 0, 0.4},
    {"C2", 20, 0, 0.4},
    {"C3", 15, 0, 0.4},
    {"C4", 10, 0, 0.4},
    {"C5", 7.5, 0, 0.4},
    {"M1", 30, 0, 0.4},
    {"M2", 20, 0, 0.4},
    {"M3", 15, 0, 0.4},
    {"M4", 10, 0, 0.4},
    {"M5", 7.5, 0, 0.35},
    {"M6", 5, 0, 0.35},
}};

/// Returns the class "P1" to "P6", "C0" to "C5", or "M1" to "M6" (as the C or P class of comparable
/// level); empty for other names.
constexpr std::optional<LightingClass> lighting_class(std::string_view name) {
  for (const LightingClass& row : en13201_classes)
    if (row.name == name) return row;
  return std::nullopt;
}

/// Share of the light that is left when luminaires are due for cleaning and replacement. It must
/// still meet the class.
constexpr double maintenance_factor = 0.8;

/// The average may exceed a P class by half before it counts as another class (EN 13201-2, 6).
constexpr double max_excess = 1.5;

}  // namespace nightcity::lights
