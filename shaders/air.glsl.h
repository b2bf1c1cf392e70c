// How far light gets through air that scatters it. C++ and GLSL both include this file, so that a
// picture's layers are made by the function that the passes use.
#ifndef NIGHTCITY_SHADERS_AIR_GLSL_H
#define NIGHTCITY_SHADERS_AIR_GLSL_H

#ifdef __cplusplus
#include <cmath>
#define AIR_FUNCTION inline
namespace nightcity::air {
using std::exp;
#else
#define AIR_FUNCTION
#endif

/// Returns the optical depth of a way of `distance` m between two heights, in m above the level at
/// which air has the `extinction`, 1/m. Extinction falls off with height as exp(-falloff * height);
/// `falloff` is the inverse of the scale height, 1/m, and 0 for air that is the same everywhere.
AIR_FUNCTION float optical_depth(float extinction, float falloff, float from, float to,
                                 float distance) {
  // The mean of exp(-falloff * height) over the way, from its lower end, where it is densest.
  float low = from < to ? from : to;
  float u = falloff * (from < to ? to - from : from - to);
  float exponent = -falloff * low;
  // Far below the level the air would be denser than floats can say.
  float densest = exp(exponent < 60.0f ? exponent : 60.0f);
  // The series spares (1 - exp(-u)) its cancellation: at 0.05 both are right to 1e-7 of 1.
  float mean = u < 0.05f ? 1.0f - u * (0.5f - u * (1.0f / 6.0f - u * (1.0f / 24.0f)))
                         : (1.0f - exp(-u)) / u;
  return extinction * densest * mean * distance;
}

#ifdef __cplusplus
}  // namespace nightcity::air
#endif
#undef AIR_FUNCTION

#endif
