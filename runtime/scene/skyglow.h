// The luminance of the night sky over a city: its own light, scattered back by the air or thrown
// back by clouds.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/scene/city_glow.h"
#include "runtime/scene/light_families.h"

namespace nightcity::scene {

/// Air over the city, after Garstang: Model for artificial night-sky illumination (Publ. Astron.
/// Soc. Pac. 98, 1986) and Night-sky brightness at observatories and sites (101, 1989): molecules
/// and aerosols that thin out exponentially with height, over flat ground at sea level.
struct Atmosphere {
  // Garstang's K: aerosols as a multiple of 11.11 times the molecules' scattering. 1 is a clear
  // night: an extinction of 0.3 magnitudes towards the zenith and a visibility of 27 km.
  double clarity = 1;
  bool overcast = false;
  double cloud_base_m = 1000;
  double cloud_reflectance = 0.6;  // of the clouds' lower side, which is matt
};

/// Luminance of a moonless sky far from cities, cd/m^2: 174 micro-cd/m^2 at the zenith (Falchi et
/// al.: The new world atlas of artificial night sky brightness, 2016).
constexpr double natural_sky_cd_m2 = 1.74e-4;

/// Returns the extinction at a height, 1/m, of green light.
double extinction_at(const Atmosphere& air, double height_m);
/// Returns the optical depth from the ground to the zenith, of green light.
double zenith_depth(const Atmosphere& air);
/// Returns the aerosols' phase function at a scattering angle in degrees, 1/sr (Garstang 1991, as
/// Cinzano, Falchi, Elvidge 2000 give it).
double aerosol_phase(double angle_deg);

/// Returns the luminance of the sky in a unit direction with y > 0, cd/m^2 per channel, seen from a
/// place on the ground (x, z; m): light is scattered once on its way. Garstang's factor for light
/// that is scattered twice, the Earth's curve and mountains are left out.
glm::dvec3 sky_luminance(const CityGlow& glow, const Atmosphere& air, const glm::dvec2& place,
                         const glm::dvec3& direction);

/// Returns the map of the sky over the middle of `bounds`; below the horizon it is dark.
SkyMap make_skyglow(const CityGlow& glow, const Atmosphere& air, const Box& bounds);

struct CitySky {
  CityGlow glow;  // of the scene alone
  SkyMap map;
};

/// Returns the sky over a scene at a time (s since noon), whose city goes on around it up to
/// `radius_m` from its middle. The map can follow the lights (SkyMap::shares). Where less than 1 %
/// of their light leaves upwards at that time, it is the map of all lights, because the few that
/// shine say little of the others.
CitySky make_city_sky(const RenderScene& scene, double time_s, LightFamilies on,
                      const Atmosphere& air, double radius_m);

}  // namespace nightcity::scene
