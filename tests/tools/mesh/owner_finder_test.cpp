#include "tools/mesh/owner_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nightcity::mesh {
namespace {

// Rectangles of every size, from a ten-thousandth of the layer to all of it.
PlaneLayer make_layer(std::uint32_t count, double offset) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 1000), size(-1, 3.1);
  PlaneLayer layer;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = place(random) + offset, y = place(random) - offset,
                 width = std::pow(10, size(random)), height = std::pow(10, size(random));
    layer.push_back(
        {{{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}}, 1000 + i});
  }
  return layer;
}

TEST(OwnerFinder, FindsWhatLookingAtEachAreaFinds) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-200, 2300);
  for (const std::uint32_t count : {1u, 2u, 30u, 2000u})
    for (const double offset : {0.0, 4e5}) {
      const PlaneLayer layer = make_layer(count, offset);
      const OwnerFinder finder(layer);
      for (int n = 0; n < 1000; ++n) {
        const glm::dvec2 p(place(random) + offset, place(random) - offset);
        std::uint32_t owner = no_label;
        for (const PlaneArea& area : layer)
          if (owner == no_label && holds(area.rings, p)) owner = area.label;
        ASSERT_EQ(finder.find(p), owner) << count << " areas";
      }
    }
}

// Each of so many listed in each square of one grid would take 16 GB.
TEST(OwnerFinder, ManyAreasAsWideAsTheLayerFit) {
  PlaneLayer layer(250'000, {{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}}, 7});
  for (std::uint32_t i = 0; i < layer.size(); ++i) layer[i].label = i;
  const OwnerFinder finder(layer);
  EXPECT_EQ(finder.find({50, 50}), 0u);
  EXPECT_EQ(finder.find({101, 50}), no_label);
}

}  // namespace
}  // namespace nightcity::mesh
