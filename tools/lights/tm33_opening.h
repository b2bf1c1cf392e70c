// The luminous opening of a TM-33 document.
#pragma once

#include <array>
#include <pugixml.hpp>

#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"

namespace nightcity::lights {

/// The box round all luminous areas of all emitters, as the three sizes of LM-63 are.
class Tm33Opening {
 public:
  explicit Tm33Opening(const TextLines& lines) : lines_(lines) {}

  /// Adds the EmissionAreas of an emitter: rectangles or circles on the faces of the luminaire,
  /// with the places of their middles, in millimetres. Throws Error with the line.
  void add(const pugi::xml_node& emitter);
  /// Sets the sizes; they stay 0, a point, where no emitter has areas.
  void give(Luminaire& luminaire) const;

 private:
  struct Axis {
    double low = 0, high = 0;
    bool known = false;
  };

  double read(const pugi::xml_node& parent, const char* name) const;
  void add_area(const pugi::xml_node& area, const std::array<double, 3>& centre);

  const TextLines& lines_;
  std::array<Axis, 3> axes_;  // length, width, height
};

}  // namespace nightcity::lights
