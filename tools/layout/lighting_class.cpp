#include "tools/layout/lighting_class.h"

#include <array>

namespace nightcity::layout {
namespace {

// EN 13201-2:2015, tables 2 (C) and 3 (P). The M classes are luminances (2, 1.5, 1, 0.75, 0.5, 0.3 cd/m2);
// their rows hold the illuminance class of comparable level in CEN/TR 13201-1:2014 (M1 to M5: C1 to C5, M6:
// P4).
constexpr std::array<LightingClass, 18> classes = {{
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

}  // namespace

std::optional<LightingClass> lighting_class(std::string_view name) {
  for (const LightingClass& row : classes)
    if (row.name == name) return row;
  return std::nullopt;
}

}  // namespace nightcity::layout
