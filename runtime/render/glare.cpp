#include "runtime/render/glare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nightcity::render {
namespace {

constexpr double degree = std::numbers::pi / 180;

// A / (1 + (angle / a)^2)^n
struct Term {
  double amplitude;  // A, 1/sr
  double width_deg;  // a
  double exponent;   // n
};

std::array<Term, 5> terms_of(double age) {
  constexpr double pigmentation = 0.5;
  const double ageing = std::pow(age / 70, 4), clear = 1 - 0.08 * ageing, cloudy = 1 + 1.6 * ageing;
  return {{{9.2e6 * clear, 0.0046, 1.5},
           {1.5e5 * clear, 0.045, 1.5},
           {400 * cloudy, 0.1, 1},
           {1300 * pigmentation * cloudy, 0.1, 1.5},
           {0.8 * pigmentation * cloudy, 0.1, 0.5}}};
}

// Returns the energy of the term's Gaussians whose widths lie between two, in radians.
double energy_between(const Term& term, double narrowest, double widest) {
  if (widest <= narrowest) return 0;
  const double a = term.width_deg * degree, range = std::log(widest / narrowest);
  const int steps = 1 + static_cast<int>(64 * range);
  const double step = range / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double width = narrowest * std::exp((i + 0.5) * step);
    const double t = a * a / (2 * width * width);
    sum += std::pow(t, term.exponent - 1) * std::exp(-t) * 2 * step;  // dt = 2 t d(ln width)
  }
  return term.amplitude * std::numbers::pi * a * a / std::tgamma(term.exponent) * sum;
}

// Returns the width of a level's Gaussian in pixels: each of the two filters between levels j and
// j + 1 has the variance 4^j.
double width_of(unsigned level) {
  return std::sqrt(2 * (std::pow(4, level) - 1) / 3);
}

}  // namespace

double glare_at(double angle_deg, double age) {
  double sum = 0;
  for (const Term& term : terms_of(age))
    sum += term.amplitude / std::pow(1 + std::pow(angle_deg / term.width_deg, 2), term.exponent);
  return sum;
}

std::vector<double> glare_weights(double age, double pixel_rad, unsigned last) {
  // Narrower Gaussians have no energy to speak of; wider ones would reach around the eye.
  constexpr double narrowest = 1e-6, widest = 1;
  std::vector<double> weights(last + 1);
  double all = 0;
  for (const Term& term : terms_of(age)) {
    double edge = narrowest;
    for (unsigned level = 0; level <= last; ++level) {
      const double between = level == 0 ? width_of(1) / std::numbers::sqrt2
                                        : std::sqrt(width_of(level) * width_of(level + 1));
      const double next = std::clamp(between * pixel_rad, edge, widest);
      const double energy = energy_between(term, edge, next);
      weights[level] += energy;
      all += energy;
      edge = next;
    }
    all += energy_between(term, edge, widest);
  }
  for (double& weight : weights) weight /= all;
  return weights;
}

}  // namespace nightcity::render
