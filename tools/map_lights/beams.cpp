#include "tools/map_lights/beams.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/lights/optics.h"

namespace nightcity::map_lights {
namespace {

using std::numbers::pi;

lights::Photometry scale_to_one_lumen(lights::Photometry photometry) {
  const double flux = lights::integrated_flux(photometry);
  for (double& value : photometry.values) value /= flux;
  return photometry;
}

}  // namespace

lights::Photometry make_area_floodlight(double reach) {
  constexpr double along = 1.3;  // mounting heights: masts two apart leave a ripple of 3 %
  const auto intensity = [reach](double c, double gamma) {
    const double cosine = std::cos(gamma);
    if (cosine < 1e-6) return 0.0;
    const double x = std::tan(gamma) * std::cos(c), y = std::tan(gamma) * std::sin(c) / along;
    // Behind the mast the light ends within half a mounting height.
    const double share = x >= 0 ? std::clamp(x / reach, 0.0, 1.0) : std::min(1.0, -2 * x);
    const double across = std::cos(share * pi / 2);
    return across * across * std::exp(-y * y) / (cosine * cosine * cosine);
  };
  return scale_to_one_lumen(lights::sample_intensity(intensity, 72, 91, 90));
}

lights::Photometry make_downlight() {
  return scale_to_one_lumen(lights::sample_intensity(
      [](double, double gamma) { return std::max(0.0, std::cos(gamma)); }, 1, 91, 90));
}

lights::Photometry make_spotlight() {
  return scale_to_one_lumen(lights::make_optic(lights::Optic::floodlight));
}

}  // namespace nightcity::map_lights
