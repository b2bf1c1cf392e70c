#include "tools/georeference/utm_zone.h"

#include <gtest/gtest.h>

namespace nightcity::georeference {
namespace {

TEST(UtmZone, IsThatOfThePlaceOnBothSidesOfTheAntimeridian) {
  EXPECT_EQ(find_utm_zone({13.4, 52.5}), "EPSG:32633");
  EXPECT_EQ(find_utm_zone({-0.1, 51.5}), "EPSG:32630");
  EXPECT_EQ(find_utm_zone({178, -18}), "EPSG:32760");
  EXPECT_EQ(find_utm_zone({-179.9, -18}), "EPSG:32701");
  EXPECT_EQ(find_utm_zone({180.1, -18}), "EPSG:32701") << "counted on beyond 180";
  EXPECT_EQ(find_utm_zone({-180.1, 10}), "EPSG:32660");
  EXPECT_EQ(find_utm_zone({180, 10}), "EPSG:32660");
}

}  // namespace
}  // namespace nightcity::georeference
