// Adaptation to a white: what is adapted to becomes grey, by a closed form.
#include "runtime/render/white.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "formats/colour.h"

namespace nightcity::render {
namespace {

void expect_grey(const glm::vec3& shown, float value, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], value, tolerance) << c;
}

TEST(White, ThatIsAdaptedToIsShownAsGrey) {
  for (const double kelvin : {2000.0, 3000.0, 6500.0, 12000.0}) {
    const glm::vec3 light = rec709_from_xy(planckian_xy(kelvin));
    expect_grey(adapt_to(light, 1) * light, 1, 2e-3f);
    // The white's luminance makes no difference.
    expect_grey(adapt_to(50.f * light, 1) * light, 1, 2e-3f);
  }
}

TEST(White, WithoutAdaptationLeavesColoursAlone) {
  const glm::mat3 matrix = adapt_to({1, 0.5f, 0.1f}, 0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(matrix[i][j], i == j ? 1 : 0, 1e-5);
  EXPECT_EQ(white_matrix({}), glm::mat3(1));
  // A scene without light has no white.
  EXPECT_EQ(white_matrix({.adapt_white = true}), glm::mat3(1));
}

// Half adapted, a cone's response lies half-way.
TEST(White, AdaptsByDegrees) {
  const glm::vec3 light(1.5f, 0.9f, 0.3f);
  const glm::vec3 none = adapt_to(light, 0) * light, all = adapt_to(light, 1) * light,
                  half = adapt_to(light, 0.5) * light;
  EXPECT_LT(glm::distance(half, 0.5f * (none + all)), 1e-4f);
}

// CIECAM02: D = F (1 - exp((-L_A - 42) / 92) / 3.6), F = 0.8 in the dark.
TEST(White, OfADimSceneIsAdaptedToInPart) {
  EXPECT_NEAR(degree_of_adaptation(0), 0.6593, 1e-3);
  EXPECT_NEAR(degree_of_adaptation(1e4), 0.8, 1e-3);
  const glm::vec3 street = 0.5f * rec709_from_xy(planckian_xy(3000));
  const glm::vec3 shown = white_matrix({.adapt_white = true, .adapted_to = street}) * street;
  EXPECT_LT(shown.r / shown.b, 0.6f * street.r / street.b);
  EXPECT_GT(shown.r / shown.b, 1.05f);
}

// Sodium light has no blue: what it scales must stay finite.
TEST(White, WithoutBlueStaysFinite) {
  const glm::mat3 matrix = adapt_to(rec709_from_xy({0.5266, 0.4131}), 1);
  const glm::mat3 red = adapt_to({1, 0, 0}, 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      EXPECT_LT(std::abs(matrix[i][j]), 60);
      EXPECT_LT(std::abs(red[i][j]), 60);
    }
}

}  // namespace
}  // namespace nightcity::render
