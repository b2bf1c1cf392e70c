#include "oracle/air.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace nightcity::oracle {

double extinction_at(const Air& air, double height) {
  return air.scale_height_m > 0
             ? air.extinction * std::exp(-(height - air.level) / air.scale_height_m)
             : air.extinction;
}

double transmittance(const Air& air, const glm::dvec3& from, const glm::dvec3& to) {
  if (!(air.extinction > 0)) return 1;
  // Simpson's rule, on parts of at most a tenth of the scale height.
  const double rise = std::abs(to.y - from.y);
  const int parts = air.scale_height_m > 0 ? 2 + 2 * int(5 * rise / air.scale_height_m) : 2;
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const double weight = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * extinction_at(air, from.y + (to.y - from.y) * i / parts);
  }
  return std::exp(-sum * glm::length(to - from) / (3 * parts));
}

double phase(const Air& air, double cosine) {
  const double g = air.asymmetry;
  return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

}  // namespace nightcity::oracle
