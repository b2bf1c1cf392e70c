// Signs and petrol stations: which light they give, and where they stand.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "tests/tools/map_lights/flat_ground.h"
#include "tests/tools/map_lights/map_of_things.h"

namespace nightcity::map_lights {
namespace {

TEST(MapLights, ASignGivesPiTimesLuminanceTimesArea) {
  const MapLightSet set = place({node(1, {0, 12}, {{"advertising", "screen"}, {"size", "4x3"}})},
                                {}, test::make_flat_ground(), make_street());
  ASSERT_EQ(set.signs.size(), 1u);
  const lights::LitRectangle& sign = set.signs[0];
  EXPECT_NEAR(sign.flux_lm(), std::numbers::pi * 300 * 12, 1e-2);
  EXPECT_NEAR(kind_of(set, MapLightKind::advertising).flux_lm, sign.flux_lm(), 1e-9);
  EXPECT_GT(sign.centre.z, 5);
  EXPECT_EQ(sign.provenance.source_id, 1u);
  EXPECT_EQ(sign.provenance.family, static_cast<std::uint8_t>(LightFamily::other));
  EXPECT_EQ(sign.provenance.position, ValueSource::tag);
}

TEST(MapLights, ASignWithOneFaceLooksAtTheRoadAndOneWithTwoStandsAcrossIt) {
  const MapLightSet set =
      place({node(1, {0, 12}, {{"advertising", "screen"}}),
             node(2, {50, 12}, {{"advertising", "poster_box"}}),
             node(3, {90, 12}, {{"advertising", "screen"}, {"direction", "N"}})},
            {}, test::make_flat_ground(), make_street());
  ASSERT_EQ(set.signs.size(), 4u);
  EXPECT_NEAR(set.signs[0].normal.y, -1, 1e-6);
  EXPECT_NEAR(std::abs(set.signs[1].normal.x), 1, 1e-6);
  EXPECT_EQ(set.signs[1].normal, -set.signs[2].normal);
  EXPECT_NEAR(set.signs[3].normal.y, 1, 1e-6);
}

TEST(MapLights, FacesStandBeforeTheirBodies) {
  const MapLightSet set = place({node(1, {0, 12}, {{"advertising", "poster_box"}}),
                                 node(2, {30, 12}, {{"advertising", "column"}, {"lit", "yes"}})});
  ASSERT_EQ(set.bodies.size(), 2u);
  ASSERT_EQ(set.signs.size(), 2u + 6u);
  for (const lights::LitRectangle& face : set.signs) {
    const Body& body = set.bodies[face.provenance.source_id - 1];
    const glm::dvec3 from_middle = face.centre - body.foot;
    const double reach = glm::dot(from_middle, glm::dvec3(face.normal));
    const double surface = body.is_column ? 0.6 * std::cos(std::numbers::pi / 6) : 0.1;
    EXPECT_NEAR(reach, surface + 0.02, 1e-6);
    EXPECT_LE(from_middle.z + double{face.half_height}, body.height_m + 1e-6);
  }
}

TEST(MapLights, AColumnHasTheLightOfTheCylinderWithinFivePercent) {
  const MapLightSet set = place({node(2, {30, 12}, {{"advertising", "column"}, {"lit", "yes"}})});
  const double cylinder = std::numbers::pi * lit_poster_cd_m2 * std::numbers::pi * 1.2 * 2.6;
  const double flux = kind_of(set, MapLightKind::advertising).flux_lm;
  EXPECT_GT(flux, 0.95 * cylinder);
  EXPECT_LE(flux, cylinder);
}

TEST(MapLights, ASignInABuildingMovesToItsWallAndLosesItsBack) {
  Ground built = test::make_flat_ground();
  built.inside = [](const glm::dvec2& p) { return p.y > 10; };
  const MapLightSet set =
      place({node(1, {0, 12}, {{"advertising", "poster_box"}})}, {}, built, make_street());
  ASSERT_EQ(set.signs.size(), 1u);
  EXPECT_LT(set.signs[0].centre.y, 10);
  EXPECT_EQ(set.signs[0].provenance.position, ValueSource::rule);
  built.inside = [](const glm::dvec2&) { return true; };
  const MapLightSet none =
      place({node(1, {0, 12}, {{"advertising", "poster_box"}})}, {}, built, make_street());
  EXPECT_TRUE(none.signs.empty());
  EXPECT_EQ(none.report.left_out.at("inside a building"), 1u);
}

}  // namespace
}  // namespace nightcity::map_lights
