// The geometry of every town's plan, tried on several seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "tools/random.h"
#include "tools/town/building_plan.h"
#include "tools/town/building_shape.h"
#include "tools/town/hills.h"
#include "tools/town/roads.h"
#include "tools/town/roof_details.h"
#include "tools/town/street_plan.h"
#include "tools/town/trees.h"

namespace nightcity::town {
namespace {

using glm::dvec2;
using glm::dvec3;
using Outline = std::vector<dvec2>;

double cross(const dvec2& a, const dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double area(const Outline& outline) {
  double twice = 0;
  for (std::size_t k = 0; k < outline.size(); ++k)
    twice += cross(outline[k], outline[(k + 1) % outline.size()]);
  return twice / 2;
}

/// Returns whether it is inside by more than a millimetre.
bool inside(const Outline& outline, const dvec2& p) {
  bool odd = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const dvec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
    const double t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    if (glm::distance(p, a + (b - a) * t) < 1e-3) return false;
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
      odd = !odd;
  }
  return odd;
}

bool edges_cross(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& d) {
  const double abc = cross(b - a, c - a), abd = cross(b - a, d - a), cda = cross(d - c, a - c),
               cdb = cross(d - c, b - c);
  const double eps = 1e-3 * std::max(glm::distance(a, b), glm::distance(c, d));
  return ((abc > eps && abd < -eps) || (abc < -eps && abd > eps)) &&
         ((cda > eps && cdb < -eps) || (cda < -eps && cdb > eps));
}

bool overlap(const Outline& a, const Outline& b) {
  for (std::size_t m = 0; m < a.size(); ++m)
    for (std::size_t n = 0; n < b.size(); ++n)
      if (edges_cross(a[m], a[(m + 1) % a.size()], b[n], b[(n + 1) % b.size()])) return true;
  const auto any_inside = [](const Outline& of, const Outline& in) {
    dvec2 middle(0);
    for (std::size_t k = 0; k < of.size(); ++k) {
      if (inside(in, of[k]) || inside(in, (of[k] + of[(k + 1) % of.size()]) * 0.5)) return true;
      middle += of[k] / static_cast<double>(of.size());
    }
    return inside(of, middle) && inside(in, middle);
  };
  return any_inside(a, b) || any_inside(b, a);
}

/// Calls visit(parcel, plans) for every block of several towns.
template <class Visit>
void for_each_block(const Visit& visit) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    TownOptions options;
    options.seed = seed;
    const StreetPlan streets(options);
    const Hills hills(seed, options.hills_m);
    for (int j = 0; j < streets.rows(); ++j)
      for (int i = 0; i < streets.columns(); ++i)
        visit(streets.parcel(i, j), plan_block(streets, hills, seed, i, j), hills);
  }
}

std::vector<BuildingPlan> bodies(const std::vector<BuildingPlan>& plans) {
  std::vector<BuildingPlan> all;
  for (const BuildingPlan& plan : plans) {
    all.push_back(plan);
    all.insert(all.end(), plan.parts.begin(), plan.parts.end());
  }
  return all;
}

TEST(Plan, FootprintsStayInTheirParcelAndOverlapNoOther) {
  std::size_t seen = 0;
  for_each_block([&](const Quad& parcel, const std::vector<BuildingPlan>& plans, const Hills&) {
    const std::vector<BuildingPlan> all = bodies(plans);
    for (std::size_t m = 0; m < all.size(); ++m) {
      EXPECT_GT(area(all[m].outline), 10);
      for (const dvec2& p : all[m].outline)
        for (std::size_t k = 0; k < 4; ++k)
          EXPECT_GT(cross(glm::normalize(parcel[(k + 1) % 4] - parcel[k]), p - parcel[k]), -1e-6);
      for (std::size_t n = m + 1; n < all.size(); ++n)
        ASSERT_FALSE(overlap(all[m].outline, all[n].outline));
      ++seen;
    }
  });
  EXPECT_GT(seen, 5000u);
}

TEST(Plan, OverlapCheckSeesOverlaps) {
  const Outline square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Outline beside{{10, 0}, {20, 0}, {20, 10}, {10, 10}};
  const Outline within{{4, 4}, {6, 4}, {6, 6}, {4, 6}};
  const Outline across{{8, 3}, {14, 3}, {14, 6}, {8, 6}};
  EXPECT_FALSE(overlap(square, beside));
  EXPECT_TRUE(overlap(square, within));
  EXPECT_TRUE(overlap(square, across));
  EXPECT_TRUE(overlap(square, square));
}

TEST(Plan, EveryBodyIsClosedPlanarAndHoldsAVolume) {
  std::map<Roof, std::size_t> roofs;
  for_each_block([&](const Quad&, const std::vector<BuildingPlan>& plans, const Hills&) {
    for (const BuildingPlan& plan : bodies(plans)) {
      ++roofs[plan.roof];
      std::map<std::tuple<long, long, long, long, long, long>, int> edges;
      double volume = 0;
      const auto key = [](const dvec3& p) {
        return std::tuple(std::lround(p.x * 1e4), std::lround(p.y * 1e4), std::lround(p.z * 1e4));
      };
      const auto walk = [&](const city::Ring& ring, const dvec3& normal) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const dvec3 &a = ring[k], &b = ring[(k + 1) % ring.size()];
          const auto from = key(a), to = key(b);
          ASSERT_NE(from, to);
          if (from < to)
            ++edges[std::tuple_cat(from, to)];
          else
            --edges[std::tuple_cat(to, from)];
          const dvec3 base = ring[0];
          volume +=
              glm::dot(glm::cross(ring[k] - base, b - base), base - dvec3(plan.outline[0], 0)) / 6;
          EXPECT_NEAR(glm::dot(normal, a - base), 0, 1e-6);
        }
      };
      for (const city::Polygon& polygon : make_surfaces(plan)) {
        dvec3 normal(0);
        const city::Ring& outer = polygon.exterior;
        for (std::size_t k = 1; k + 1 < outer.size(); ++k)
          normal += glm::cross(outer[k] - outer[0], outer[k + 1] - outer[0]);
        ASSERT_GT(glm::length(normal), 1e-3);
        normal = glm::normalize(normal);
        if (polygon.surface == city::SurfaceType::roof) {
          EXPECT_GT(normal.z, 0.05);
        }
        if (polygon.surface == city::SurfaceType::ground) {
          EXPECT_LT(normal.z, -0.99);
        }
        if (polygon.surface == city::SurfaceType::wall) {
          EXPECT_NEAR(normal.z, 0, 1e-9);
        }
        walk(polygon.exterior, normal);
        for (const city::Ring& hole : polygon.interiors) walk(hole, normal);
      }
      for (const auto& [edge, balance] : edges)
        ASSERT_EQ(balance, 0) << "roof " << static_cast<int>(plan.roof);
      EXPECT_GT(volume, 30);
    }
  });
  EXPECT_EQ(roofs.size(), 6u);
}

TEST(Plan, RoofDetailsStandOnTheirRoofWithinTheHouse) {
  std::size_t dormers = 0, chimneys = 0;
  for_each_block([&](const Quad&, const std::vector<BuildingPlan>& plans, const Hills&) {
    std::size_t number = 0;
    for (const BuildingPlan& plan : plans) {
      for (const RoofDetail& detail : make_roof_details(plan, 1, number++)) {
        ++(detail.chimney ? chimneys : dormers);
        for (const city::Polygon& polygon : detail.surfaces) {
          ASSERT_GE(polygon.exterior.size(), 3u);
          const dvec3 normal =
              glm::normalize(glm::cross(polygon.exterior[1] - polygon.exterior[0],
                                        polygon.exterior[2] - polygon.exterior[0]));
          if (polygon.surface == city::SurfaceType::roof) {
            EXPECT_GT(normal.z, 0.9);
          }
          if (polygon.surface == city::SurfaceType::wall) {
            EXPECT_NEAR(normal.z, 0, 1e-9);
          }
          for (const dvec3& p : polygon.exterior) {
            EXPECT_TRUE(inside(plan.outline, dvec2(p)));
            EXPECT_GT(p.z, plan.eave_m);
            EXPECT_LT(p.z, plan.ridge_m + 1);
          }
        }
      }
    }
  });
  EXPECT_GT(dormers, 1000u);
  EXPECT_GT(chimneys, 1000u);
}

TEST(Plan, TreesKeepClearOfHousesKerbsAndEachStandsOnTheGround) {
  std::size_t trees = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const StreetPlan streets(TownOptions{.seed = seed});
    const Hills hills(seed, 12);
    for (int j = 0; j < streets.rows(); ++j)
      for (int i = 0; i < streets.columns(); ++i) {
        const std::vector<BuildingPlan> houses = plan_block(streets, hills, seed, i, j);
        const Quad parcel = streets.parcel(i, j);
        for (const TreePlan& tree : plan_trees(streets, hills, houses, seed, i, j)) {
          ++trees;
          for (int n = 0; n < 12; ++n) {
            const double angle = n * 0.5236;
            const dvec2 rim =
                tree.foot + tree.crown_radius_m * dvec2(std::cos(angle), std::sin(angle));
            for (const BuildingPlan& house : houses) {
              const bool yard = !house.hole.empty() && inside(house.hole, rim);
              EXPECT_TRUE(yard || !inside(house.outline, rim));
            }
            for (std::size_t k = 0; k < 4; ++k)
              EXPECT_GT(cross(glm::normalize(parcel[(k + 1) % 4] - parcel[k]), rim - parcel[k]),
                        1.0);
          }
          double low = 1e9, high = -1e9;
          std::size_t triangles = 0;
          for (const city::Ring& ring : make_tree_surfaces(tree)) {
            triangles += ring.size() - 2;
            for (const dvec3& p : ring) low = std::min(low, p.z), high = std::max(high, p.z);
          }
          EXPECT_EQ(triangles, 32u);
          EXPECT_LT(low, hills.height(tree.foot));
          EXPECT_NEAR(high, hills.height(tree.foot) + tree.height_m, 1e-9);
        }
      }
  }
  EXPECT_GT(trees, 400u);
}

TEST(Plan, RoadsLieAboveTheTerrainAndNoHigherThanAKerb) {
  for (const double relief : {0.0, 12.0, 60.0}) {
    TownOptions options;
    const StreetPlan streets(options);
    const Hills hills(3, relief);
    Random random{99};
    for_each_road(streets, hills, [&](const RoadPlan& road) {
      for (const RoadArea& area : road.areas)
        for (const city::Ring& ring : area.rings) {
          if (ring.size() == 4) {  // a kerb's face: upright, from the terrain to the pavement
            for (const std::size_t k : {0u, 1u}) {
              EXPECT_EQ(dvec2(ring[k]), dvec2(ring[3 - k]));
              EXPECT_NEAR(ring[k].z, hills.height(dvec2(ring[k])), 1e-9);
              EXPECT_NEAR(ring[3 - k].z - ring[k].z, Hills::pavement_lift_m, 1e-9);
            }
            continue;
          }
          ASSERT_EQ(ring.size(), 3u);
          double u = random.uniform(), v = random.uniform();
          if (u + v > 1) u = 1 - u, v = 1 - v;
          const dvec3 p = ring[0] + (ring[1] - ring[0]) * u + (ring[2] - ring[0]) * v;
          EXPECT_GT(cross(dvec2(ring[1] - ring[0]), dvec2(ring[2] - ring[0])), 0);
          const double above = p.z - hills.height(dvec2(p));
          ASSERT_GT(above, 0.01);
          ASSERT_LT(above, 0.30);
        }
    });
  }
}

TEST(Plan, HeightOfTheTerrainIsItsGridAndLinearBetween) {
  const Hills hills(1, 20);
  const double s = Hills::spacing_m;
  EXPECT_NEAR(hills.height({3 * s, -4 * s}), hills.smooth({3 * s, -4 * s}), 1e-9);
  const double a = hills.height({0, 0}), b = hills.height({s, 0}), c = hills.height({s, s});
  EXPECT_NEAR(hills.height({0.75 * s, 0.25 * s}), 0.25 * a + 0.5 * b + 0.25 * c, 1e-9);
  for (int n = 0; n < 100; ++n) {
    const double z = hills.height({n * 37.0, n * -53.0});
    EXPECT_GE(z, hills.lowest() - 1e-9);
    EXPECT_LE(z, hills.highest() + 1e-9);
  }
}

TEST(Random, StreamsAreFixedForGoodAndSpreadEvenly) {
  // These numbers decide how the town of a seed looks: they must not change between platforms or
  // versions.
  Random random{1, 2, 3};
  EXPECT_EQ(random.next(), 1321962074176129191ull);
  int counts[6] = {};
  for (int n = 0; n < 60000; ++n) ++counts[random.integer(0, 5)];
  for (const int count : counts) EXPECT_NEAR(count, 10000, 400);
  for (int n = 0; n < 1000; ++n) {
    const double u = random.uniform();
    EXPECT_GE(u, 0);
    EXPECT_LT(u, 1);
  }
}

}  // namespace
}  // namespace nightcity::town
