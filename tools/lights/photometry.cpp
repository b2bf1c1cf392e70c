#include "tools/lights/photometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace nightcity::lights {

using std::numbers::pi;

Photometry sample_intensity(const Intensity& intensity, std::uint32_t c_count,
                            std::uint32_t gamma_count, double extent_degrees) {
  Photometry result{c_count, gamma_count, {}, extent_degrees};
  const double extent = extent_degrees * pi / 180;
  result.values.reserve(static_cast<std::size_t>(c_count) * gamma_count);
  for (std::uint32_t c = 0; c < c_count; ++c)
    for (std::uint32_t g = 0; g < gamma_count; ++g)
      result.values.push_back(intensity(2 * pi * c / c_count, extent * g / (gamma_count - 1)));
  return result;
}

double integrated_flux(const Photometry& photometry) {
  // The interpolant is linear and periodic in C: the integral is the mean over the rows, times 2
  // pi. It is linear in gamma between a and b: integral of f sin = f(a) cos a - f(b) cos b + slope
  // (sin b - sin a).
  const std::size_t count = photometry.gamma_count;
  const double step = photometry.extent_degrees * pi / 180 / static_cast<double>(count - 1);
  double sum = 0;
  for (std::size_t row = 0; row < photometry.c_count; ++row)
    for (std::size_t g = 0; g + 1 < count; ++g) {
      const double a = step * static_cast<double>(g), b = step * static_cast<double>(g + 1);
      const double fa = photometry.values[row * count + g],
                   fb = photometry.values[row * count + g + 1];
      sum += fa * std::cos(a) - fb * std::cos(b) + (fb - fa) / step * (std::sin(b) - std::sin(a));
    }
  return sum * 2 * pi / photometry.c_count;
}

double intensity_at(const Photometry& photometry, double c, double gamma) {
  const double extent = photometry.extent_degrees * pi / 180;
  if (gamma > extent * (1 + 1e-12)) return 0;
  const double turns = c / (2 * pi) - std::floor(c / (2 * pi));
  const double row = turns * photometry.c_count;
  const double column = std::clamp(gamma / extent, 0.0, 1.0) * (photometry.gamma_count - 1);
  const auto r = static_cast<std::size_t>(row);
  const auto g =
      std::min<std::size_t>(static_cast<std::size_t>(column), photometry.gamma_count - 2);
  const double fr = row - static_cast<double>(r), fg = column - static_cast<double>(g);
  // The rows are periodic. Nearly none is past the end, and a division takes long.
  const auto find_row = [&](std::size_t i) {
    const std::size_t in_period = i < photometry.c_count ? i : i % photometry.c_count;
    return photometry.values.data() + in_period * photometry.gamma_count;
  };
  const double *low = find_row(r), *high = find_row(r + 1);
  return (low[g] * (1 - fg) + low[g + 1] * fg) * (1 - fr) +
         (high[g] * (1 - fg) + high[g + 1] * fg) * fr;
}

std::uint32_t ProfileTable::add(std::string_view name, const Photometry& photometry) {
  const auto known = std::find(names_.begin(), names_.end(), name);
  if (known != names_.end()) return static_cast<std::uint32_t>(known - names_.begin());
  for (const double value : photometry.values)
    if (!(value >= 0 && std::isfinite(value)))
      throw std::invalid_argument("negative or infinite intensity");
  const double flux = integrated_flux(photometry);
  if (!(flux > 0 && std::isfinite(flux))) throw std::invalid_argument("a luminaire without flux");
  profiles.push_back({photometry.c_count, photometry.gamma_count,
                      static_cast<std::uint32_t>(data.size()),
                      static_cast<float>(photometry.extent_degrees)});
  for (const double value : photometry.values) data.push_back(static_cast<float>(value / flux));
  names_.emplace_back(name);
  return static_cast<std::uint32_t>(names_.size() - 1);
}

}  // namespace nightcity::lights
