// The last step of a layout: with every lamp in its place, the flux that brings each street to its class, and
// what each street has got.
#pragma once

#include "tools/layout/layout.h"
#include "tools/layout/layout_design.h"
#include "tools/streets/street_network.h"

namespace nightcity::layout {

struct StreetPlanned {
  bool lit = false;  // in the model and planned
  LightingClass wanted{};
  LampDesign design;
  int side = -1;                   // of its lamps: +1 left of the street's direction
  std::size_t left_to_mapped = 0;  // places that mapped lamps light
};

/// The lamps set.lamps[first_new...] belong to streets `street_of_lamp`; all of a street have one flux.
/// Solved by Gauss-Seidel, since streets light each other, each flux kept within a factor of `widest_change`
/// of its design; then the next greater package. Fills report.streets and report.classes; a street most of
/// whose places are left to mapped lamps is only counted, for their light is not the layout's doing. `plans`
/// parallel to the network's streets.
void fit_flux(const streets::StreetNetwork& network, const std::vector<StreetPlanned>& plans,
              const HeightAt& height_at, LampSet& set, std::size_t first_new,
              const std::vector<std::size_t>& street_of_lamp, LayoutReport& report);
constexpr double widest_change = 2.5;

/// A profile of the set in candela per lumen.
Photometry profile_of(const LampSet& set, std::uint32_t profile);
/// Its number in the set; an equal one that is there is used again.
std::uint32_t add_profile(LampSet& set, const Photometry& photometry);

}  // namespace nightcity::layout
