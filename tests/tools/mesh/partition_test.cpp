#include "tools/mesh/partition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <numbers>
#include <random>

#include "formats/error.h"

namespace nightcity::mesh {
namespace {

PlaneArea rectangle(double x0, double y0, double x1, double y1, std::uint32_t label) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, label};
}

double area_of(const PlanePartition& plan, const PlanePartition::Triangle& t) {
  const glm::dvec2 a = plan.points[t.vertex[0]], b = plan.points[t.vertex[1]] - a,
                   c = plan.points[t.vertex[2]] - a;
  return (b.x * c.y - b.y * c.x) / 2;
}

// Returns the area of each owner in the first layer.
std::map<std::uint32_t, double> areas_of(const PlanePartition& plan) {
  std::map<std::uint32_t, double> areas;
  for (const PlanePartition::Triangle& t : plan.triangles) {
    EXPECT_GT(area_of(plan, t), 0);
    areas[plan.owners[t.region][0]] += area_of(plan, t);
  }
  return areas;
}

TEST(Partition, TheFirstAreaOwnsAnOverlap) {
  const std::vector<PlaneLayer> layers{{rectangle(0, 0, 10, 10, 1), rectangle(5, 5, 20, 20, 2)}};
  const auto areas = areas_of(partition(layers));
  EXPECT_NEAR(areas.at(1), 100, 1e-9);
  EXPECT_NEAR(areas.at(2), 225 - 25, 1e-9);
  EXPECT_EQ(areas.size(), 2u);
}

TEST(Partition, AreasOfOneLabelAreOneRegionWithoutTheirInnerOutlines) {
  const std::vector<PlaneLayer> layers{{rectangle(0, 0, 10, 4, 7), rectangle(3, -5, 7, 9, 7)}};
  const PlanePartition plan = partition(layers);
  EXPECT_NEAR(areas_of(plan).at(7), 40 + 56 - 16, 1e-9);
  EXPECT_EQ(plan.points.size(), 12u);     // the corners of a cross
  EXPECT_EQ(plan.triangles.size(), 10u);  // n - 2
}

TEST(Partition, EachLayerHasItsOwnOwners) {
  const std::vector<PlaneLayer> layers{{rectangle(0, 0, 4, 4, 1)}, {rectangle(2, 0, 6, 4, 5)}};
  const PlanePartition plan = partition(layers);
  std::map<std::vector<std::uint32_t>, double> areas;
  for (const PlanePartition::Triangle& t : plan.triangles)
    areas[plan.owners[t.region]] += area_of(plan, t);
  EXPECT_NEAR((areas.at({1, no_label})), 8, 1e-9);
  EXPECT_NEAR((areas.at({1, 5})), 8, 1e-9);
  EXPECT_NEAR((areas.at({no_label, 5})), 8, 1e-9);
}

TEST(Partition, AHoleBelongsToWhatLiesBelow) {
  PlaneArea ring = rectangle(0, 0, 10, 10, 1);
  ring.rings.push_back(rectangle(2, 2, 4, 4, 0).rings[0]);
  const std::vector<PlaneLayer> layers{{ring, rectangle(1, 1, 5, 5, 2)}};
  const auto areas = areas_of(partition(layers));
  EXPECT_NEAR(areas.at(1), 96, 1e-9);
  EXPECT_NEAR(areas.at(2), 4, 1e-9);
}

// The owners of random places, by the definition; and the area of the union, by the share of
// random places that lie in it.
TEST(Partition, RandomStarsAreDisjointAndWhole) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 100), angle(0, 6.283);
  PlaneLayer layer;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const glm::dvec2 middle(place(random), place(random));
    std::vector<glm::dvec2> ring;  // crosses itself
    for (int k = 0; k < 9; ++k) {
      const double a = angle(random), r = place(random) / 4;
      ring.push_back(middle + r * glm::dvec2(std::cos(a), std::sin(a)));
    }
    layer.push_back({{ring}, i % 5});
  }
  const std::vector<PlaneLayer> layers{layer};
  const PlanePartition plan = partition(layers);
  std::map<std::uint32_t, double> sampled;
  constexpr int samples = 200'000;
  for (int n = 0; n < samples; ++n) {
    const glm::dvec2 p(place(random) * 2 - 50, place(random) * 2 - 50);
    for (const PlaneArea& area : layer)
      if (holds(area.rings, p)) {
        sampled[area.label] += 200.0 * 200.0 / samples;
        break;
      }
  }
  for (const auto& [label, area] : areas_of(plan))  // five standard deviations of the sampling
    EXPECT_NEAR(area, sampled.at(label), 5 * std::sqrt(area * 40'000 / samples)) << label;
  // Triangles do not overlap: a random place lies in one of them or in none.
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec2 p(place(random), place(random));
    std::uint32_t owner = no_label;
    int found = 0;
    for (const PlanePartition::Triangle& t : plan.triangles) {
      const std::vector<std::vector<glm::dvec2>> corners{
          {plan.points[t.vertex[0]], plan.points[t.vertex[1]], plan.points[t.vertex[2]]}};
      if (!holds(corners, p)) continue;
      ++found;
      owner = plan.owners[t.region][0];
    }
    EXPECT_LE(found, 1);
    std::uint32_t expected = no_label;
    for (auto area = layer.rbegin(); area != layer.rend(); ++area)
      if (holds(area->rings, p)) expected = area->label;
    EXPECT_EQ(owner, expected);
  }
}

// Returns what of a ring lies above a height, as outlines are cut to tiles of the ground.
std::vector<glm::dvec2> cut_below(const std::vector<glm::dvec2>& ring, double low) {
  std::vector<glm::dvec2> cut;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (a.y >= low) cut.push_back(a);
    if ((a.y >= low) != (b.y >= low))
      cut.emplace_back(a.x + (b.x - a.x) * (low - a.y) / (b.y - a.y), low);
  }
  for (glm::dvec2& p : cut) p = glm::round(p * 1024.0) / 1024.0;
  return cut;
}

double area_of(const std::vector<glm::dvec2>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += (a.x * b.y - b.x * a.y) / 2;
  }
  return sum;
}

// An area with a hole is cut along one line that lies less than a millimetre from the lowest corner
// of a facet of the ground: edges overlap there, and two sides of the facet cross them.
TEST(Partition, EdgesThatOverlapAreCrossedWhereTheyLie) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share;
    const auto about = [&](double value, double spread) {
      return static_cast<double>(static_cast<float>(value + spread * share(random)));
    };
    const auto star = [&](double low_m, double high_m, int corners) {
      std::vector<glm::dvec2> ring;
      for (int i = 0; i < corners; ++i) {
        const double turn = 2 * std::numbers::pi * i / corners,
                     away = low_m + (high_m - low_m) * share(random);
        ring.emplace_back(30 + away * std::cos(turn), -22 + away * std::sin(turn));
      }
      return ring;
    };
    const double low = about(-29.5, 0.001);
    const std::vector<glm::dvec2> facet{{about(30.4, 0.2), low},
                                        {about(90, 0.002), about(30, 0.002)},
                                        {about(30.4, 0.001), about(30, 0.001)},
                                        {-29.5, 30}};
    const PlaneArea area{{cut_below(star(12, 20, 22), low), cut_below(star(8.2, 9.5, 9), low)}, 3};
    const std::vector<PlaneLayer> layers{{area}, {{{facet}, 7}}};
    const PlanePartition plan = partition(layers);
    double facet_m2 = 0;
    for (const PlanePartition::Triangle& t : plan.triangles)
      if (plan.owners[t.region][1] == 7) facet_m2 += area_of(plan, t);
    EXPECT_NEAR(facet_m2, area_of(facet), 0.01) << seed;
  }
}

TEST(Partition, WhatIsNoAreaGivesNone) {
  EXPECT_TRUE(partition({}).triangles.empty());
  const double nan = std::nan("");
  const std::vector<PlaneLayer> layers{
      {{{{}}, 1}, {{{{1, 1}}}, 2}, {{{{0, 0}, {5, 5}}}, 3}, {{{{nan, 0}, {0, nan}, {1, 1}}}, 4}}};
  EXPECT_TRUE(partition(layers).triangles.empty());
}

TEST(Partition, ANotANumberVertexIsLeftOut) {
  PlaneArea area = rectangle(0, 0, 2, 2, 1);
  area.rings[0].insert(area.rings[0].begin() + 1, {std::nan(""), 7});
  const std::vector<PlaneLayer> layers{{area}};
  // The area itself is asked with its vertex, so a part of it may belong to nobody.
  double sum = 0;
  const PlanePartition plan = partition(layers);
  for (const PlanePartition::Triangle& t : plan.triangles) sum += area_of(plan, t);
  EXPECT_LE(sum, 4 + 1e-9);
}

TEST(Partition, OutlinesThatCrossTooOftenAreRefused) {
  PlaneLayer layer;
  for (int i = 0; i < 400; ++i) {  // 800 lines, each across all others
    layer.push_back(rectangle(i, -1000, i + 0.5, 1000, 1));
    layer.push_back(rectangle(-1000, i, 1000, i + 0.5, 2));
  }
  const std::vector<PlaneLayer> layers{layer};
  EXPECT_THROW(partition(layers), Error);
}

}  // namespace
}  // namespace nightcity::mesh
