// The last step of a layout: finds the flux that brings each street to its class, now that every
// lamp has its place, and reports what each street gets.
#pragma once

#include "tools/layout/layout.h"
#include "tools/layout/layout_design.h"
#include "tools/streets/street_network.h"

namespace nightcity::layout {

struct StreetPlanned {
  bool lit = false;  // lies in the model and has a design
  lights::LightingClass wanted{};
  LampDesign design;
  int side = -1;                   // of its lamps: +1 left of the street's direction
  std::size_t left_to_mapped = 0;  // places that mapped lamps light
};

/// Sets the flux of the lamps set.lamps[first_new...], which belong to the streets
/// `street_of_lamp`. All lamps of a street have one flux. Streets light each other, so the fluxes
/// are solved by Gauss-Seidel iteration, each within a factor of `max_change` of its design; then
/// the next greater package is taken. Fills report.streets and report.classes. A street whose
/// places are mostly left to mapped lamps is only counted, because the layout does not light it.
/// `plans` is parallel to the network's streets.
void fit_flux(const streets::StreetNetwork& network, const std::vector<StreetPlanned>& plans,
              const place::HeightAt& height_at, lights::LampSet& set, std::size_t first_new,
              const std::vector<std::size_t>& street_of_lamp, LayoutReport& report);
constexpr double max_change = 2.5;

/// Returns a profile of the set in candela per lumen.
lights::Photometry profile_of(const lights::LampSet& set, std::uint32_t profile);
/// Adds a profile to the set, unless it holds an equal one, and returns its number.
std::uint32_t add_profile(lights::LampSet& set, const lights::Photometry& photometry);

}  // namespace nightcity::layout
