// The eye's point spread function against another published equation and its own norm.
#include "runtime/render/glare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace nightcity::render {
namespace {

constexpr double degree = std::numbers::pi / 180;

// All light that enters the eye arrives somewhere: 2 pi integral glare sin(angle) d(angle) = 1.
TEST(Glare, HasTheNormOne) {
  double sum = 0;
  constexpr int steps = 200'000;
  const double low = std::log(1e-5), step = (std::log(90.0) - low) / steps;
  for (int i = 0; i < steps; ++i) {
    const double angle = std::exp(low + (i + 0.5) * step);
    sum += glare_at(angle, 25) * std::sin(angle * degree) * angle * degree * step;
  }
  EXPECT_NEAR(2 * std::numbers::pi * sum, 1, 0.03);
}

// The General Disability Glare equation of CIE 146:2002 is a simpler fit to the same data, from 0.1
// to 100 degrees. People differ by more than the two do.
TEST(Glare, AgreesWithTheGeneralDisabilityGlareEquation) {
  for (const double age : {20.0, 50.0, 80.0})
    for (const double angle : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
      const double ageing = 1 + std::pow(age / 62.5, 4);
      const double general =
          10 / std::pow(angle, 3) + (5 / (angle * angle) + 0.1 * 0.5 / angle) * ageing;
      EXPECT_NEAR(glare_at(angle, age) / general, 1, 0.4) << age << " years, " << angle;
    }
}

// Nothing is added to the light, whatever the age, the pixel and the size of the picture.
TEST(Glare, WeightsShareOutTheLight) {
  for (const double age : {1.0, 25.0, 70.0, 100.0})
    for (const double pixel_rad : {1e-6, 1e-4, 5e-4, 5e-3, 0.1, 1.0})
      for (const unsigned last : {1u, 2u, 9u, 15u}) {
        const std::vector<double> weights = glare_weights(age, pixel_rad, last);
        ASSERT_EQ(weights.size(), last + 1);
        for (const double weight : weights) EXPECT_GE(weight, 0) << age << " " << pixel_rad;
        EXPECT_LE(std::accumulate(weights.begin(), weights.end(), 0.0), 1 + 1e-9);
      }
}

}  // namespace
}  // namespace nightcity::render
