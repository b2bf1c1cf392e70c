// Shells over outlines: closed, with the volume of closed forms.
#include "tools/map_buildings/roofs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tools/map_buildings/roof_volume.h"
#include "tools/city/ring.h"

namespace nightcity::map_buildings {
namespace {

TEST(Roofs, ARectangleUnderEveryRoofHasItsVolume) {
  expect_shell(rectangle, sizes(RoofShape::flat), 60 * 8);
  expect_shell(rectangle, sizes(RoofShape::flat, 3), 60 * 5);
  expect_shell(rectangle, sizes(RoofShape::gabled), 60 * 5 + 60 * 3 / 2.0);
  expect_shell(rectangle, sizes(RoofShape::skillion), 60 * 5 + 60 * 3 / 2.0);
  expect_shell(rectangle, sizes(RoofShape::pyramidal), 60 * 5 + 60 * 3 / 3.0);
  // A prism 4 m long, and a pyramid of the two ends: its ridge begins 3 m from each short side.
  expect_shell(rectangle, sizes(RoofShape::hipped), 60 * 5 + 6 * 3 / 2.0 * 4 + 36 * 3 / 3.0);
}

TEST(Roofs, BrokenAndCurvedRoofsHaveTheVolumeOfTheirClosedForms) {
  const double share = std::sqrt(0.5);
  // Two trapezoids below a gable.
  const double gambrel = 6 * 3 * (share * (1 + share) / 2 + share * (1 - share) / 2);
  expect_shell(rectangle, sizes(RoofShape::gambrel), 60 * 5 + 10 * gambrel);
  // The short slope begins at half the rise: 0.75 over a third of the width, 0.5 over the rest.
  expect_shell(rectangle, sizes(RoofShape::saltbox), 60 * 5 + 60 * 3 * (0.75 / 3 + 0.5 * 2 / 3));
  // A gable without a tetrahedron at each end: half of its height and width, a quarter deep.
  expect_shell(rectangle, sizes(RoofShape::half_hipped),
               60 * 5 + 60 * 3 / 2.0 - 2 * (3 * 1.5 / 2 * 1.5 / 3));
  // A prismatoid (Simpson's rule is exact), and a hipped roof on what it leaves.
  const double inset = (1 - share) * 3;
  const auto plan = [](double x) { return (10 - 2 * x) * (6 - 2 * x); };
  const double below = share * 3 / 6 * (60 + 4 * plan(inset / 2) + plan(inset));
  const double width = 6 - 2 * inset, ridge = 10 - 6, rise = 3 * (1 - share);
  const double above = width * rise / 2 * ridge + width * width * rise / 3;
  expect_shell(rectangle, sizes(RoofShape::mansard), 60 * 5 + below + above);
}

TEST(Roofs, RarerRoofsHaveTheVolumeOfTheirClosedForms) {
  const double block = 60 * 5;
  expect_shell(rectangle, sizes(RoofShape::butterfly), block + 60 * 3 / 2.0);
  expect_shell(rectangle, sizes(RoofShape::sawtooth), block + 60 * 3 / 2.0);
  expect_shell(rectangle, sizes(RoofShape::gabled_row), block + 60 * 3 / 2.0);
  expect_shell(rectangle, sizes(RoofShape::double_saltbox), block + 60 * 3 * 2 / 3.0);
  // A gable without the wedge that the hip at one end takes: half of the width deep.
  const double wedge = 6 * 3 / 2.0 * 3 / 3;
  expect_shell(rectangle, sizes(RoofShape::side_hipped), block + 60 * 3 / 2.0 - wedge);
  expect_shell(rectangle, sizes(RoofShape::side_half_hipped),
               block + 60 * 3 / 2.0 - 3 * 1.5 / 2 * 1.5 / 3);
  // A hipped roof, and at both ends what stands between its hip and the gable above it.
  const double hipped = 60 * 3 / 2.0 - 2 * wedge, gable = 3 * 1.5 / 2;
  expect_shell(rectangle, sizes(RoofShape::gablet), block + hipped + 2 * gable * 1.5 / 3);
  // A frustum 2 m further in: Simpson's rule is exact.
  expect_shell(rectangle, sizes(RoofShape::quadruple_saltbox),
               block + 3 / 6.0 * (60 + 4 * 8 * 4 + 6 * 2));
  expect_shell(rectangle, sizes(RoofShape::crosspitched), block + 60 * 3 * 2 / 3.0);
}

TEST(Roofs, ARoundRoofIsAnArcOrHalfAnEllipse) {
  // Rise 2 over half a width of 3: the radius is (2^2 + 3^2) / 4, the half angle 2 atan(2 / 3).
  const double radius = 13 / 4.0, angle = 2 * std::atan(2 / 3.0);
  const double segment = radius * radius * (angle - std::sin(angle) * std::cos(angle));
  EXPECT_NEAR(volume_of(rectangle, sizes(RoofShape::round, 0, 5, 7)) - 300, 10 * segment,
              0.01 * 10 * segment);
  const double ellipse = std::numbers::pi / 2 * 3 * 4;
  EXPECT_NEAR(volume_of(rectangle, sizes(RoofShape::round, 0, 5, 9)) - 300, 10 * ellipse,
              0.015 * 10 * ellipse);
}

TEST(Roofs, DomesAndOnionsAreBodiesOfSimilarSections) {
  Outline circle;
  constexpr int corners = 32;
  for (int i = 0; i < corners; ++i)
    circle.outer.emplace_back(4 * std::cos(2 * std::numbers::pi * i / corners),
                              4 * std::sin(2 * std::numbers::pi * i / corners));
  const double area = 16 * corners / 2.0 * std::sin(2 * std::numbers::pi / corners);
  const double dome = volume_of(circle, sizes(RoofShape::dome, 0, 5, 9)) - 5 * area;
  EXPECT_NEAR(dome, area * 4 * 2 / 3, 0.01 * area * 4);  // half an ellipsoid
  // By the midpoint rule: the integral of the squared radius over the height.
  double sum = 0;
  constexpr int steps = 20'000;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps, c = std::cos(std::numbers::pi / 2 * t);
    sum += std::pow(c, 4) * std::pow(1 + 1.5 * t, 2) / steps;
  }
  const double onion = volume_of(circle, sizes(RoofShape::onion, 0, 5, 9)) - 5 * area;
  EXPECT_NEAR(onion, area * 4 * sum, 0.01 * area * 4);
  // Neither over a long hall nor over an angle that the centroid does not see whole.
  const Outline hall{{{0, 0}, {40, 0}, {40, 6}, {0, 6}}, {}};
  expect_shell(hall, sizes(RoofShape::dome), 240 * 8, true);
  expect_shell(rectangle, sizes(RoofShape::onion, 3, 5, 8),
               volume_of(rectangle, sizes(RoofShape::onion, 3, 5, 8)));
}

TEST(Roofs, OnlyWhatStandsOnTheGroundHasAGroundSurface) {
  bool flat = false;
  EXPECT_EQ(make_shell(rectangle, sizes(RoofShape::flat), flat).back().surface,
            city::SurfaceType::ground);
  EXPECT_EQ(make_shell(rectangle, sizes(RoofShape::flat, 2), flat).back().surface,
            city::SurfaceType::outer_ceiling);
}

TEST(Roofs, OtherOutlinesGetWhatFitsThem) {
  const Outline angle{{{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}}, {}};  // 64 m2
  expect_shell(angle, sizes(RoofShape::flat), 64 * 8);
  expect_shell(angle, sizes(RoofShape::hipped), 64 * 8, true);
  // Its centroid sees every edge; that of the other does not even lie in it.
  expect_shell(angle, sizes(RoofShape::pyramidal), 64 * 5 + 64 * 3 / 3.0);
  const Outline horseshoe{{{0, 0}, {12, 0}, {12, 10}, {8, 10}, {8, 4}, {4, 4}, {4, 10}, {0, 10}},
                          {}};  // 96 m2
  expect_shell(horseshoe, sizes(RoofShape::pyramidal), 96 * 8, true);
  Outline court = rectangle;
  court.holes.push_back({{4, 2}, {4, 4}, {6, 4}, {6, 2}});  // clockwise
  expect_shell(court, sizes(RoofShape::flat), 56 * 8);
  expect_shell(court, sizes(RoofShape::gabled), 56 * 8, true);
  expect_shell(court, sizes(RoofShape::skillion), 56 * 5 + 56 * 3 / 2.0);
  const Outline hexagon{{{2, 0}, {4, 0}, {5, 2}, {4, 4}, {2, 4}, {1, 2}}, {}};  // 12 m2
  expect_shell(hexagon, sizes(RoofShape::pyramidal), 12 * 5 + 12 * 3 / 3.0);
}

// A turned, shifted and skewed outline has the volume of a prism's share, and nothing of it lies
// above the top or below the eaves but walls.
TEST(Roofs, ShapesKeepTheirShareOfThePrismWhereverTheRectangleLies) {
  const double share = std::sqrt(0.5);
  const std::pair<RoofShape, double> shapes[] = {
      {RoofShape::gabled, 0.5},
      {RoofShape::gambrel, share},
      {RoofShape::saltbox, 0.25 + 1 / 3.0},
  };
  for (const auto& [roof, part] : shapes)
    for (const double size : {0.5, 1.0, 30.0})
      for (int step = 0; step < 12; ++step) {
        const double angle = 0.1 + step * std::numbers::pi / 6;
        const glm::dvec2 u(std::cos(angle), std::sin(angle)), v(-u.y, u.x), corner(-300, 70);
        Outline outline;
        for (const glm::dvec2 c : {glm::dvec2(0, 0), {10, 0}, {10, 6}, {0, 6}})
          outline.outer.push_back(corner + size * (c.x * u + c.y * v));
        // A vertex in a long side, as a neighbour's corner sets it.
        outline.outer.insert(outline.outer.begin() + 1, corner + size * 3.7 * u);
        bool flat = false;
        const auto shell = make_shell(outline, sizes(roof), flat);
        EXPECT_FALSE(flat);
        EXPECT_TRUE(is_closed(shell));
        const double area = 60 * size * size;
        EXPECT_NEAR(shell_volume(shell), area * (5 + 3 * part), 1e-6 * area * 10) << step;
      }
}

TEST(Roofs, WhatDoesNotFitIsFlatAndClosed) {
  const Outline outlines[] = {
      // A comb, whose teeth every line across cuts several times.
      {{{0, 0}, {9, 0}, {9, 6}, {8, 6}, {8, 1}, {7, 1}, {7, 6}, {6, 6}, {6, 1}, {5, 1},
        {5, 6}, {4, 6}, {4, 1}, {3, 1}, {3, 6}, {2, 6}, {2, 1}, {1, 1}, {1, 6}, {0, 6}},
       {}},
      {{{0, 0}, {1e-7, 0}, {1e-7, 1e-7}}, {}},
      {{{0, 0}, {10, 0}, {10, 0}, {10, 6}}, {}},
      {{{0, 0}, {5, 0}, {10, 0}}, {}},
  };
  for (const Outline& outline : outlines)
    for (const RoofShape roof :
         {RoofShape::gabled, RoofShape::gambrel, RoofShape::round, RoofShape::saltbox,
          RoofShape::hipped, RoofShape::half_hipped, RoofShape::mansard, RoofShape::pyramidal,
          RoofShape::dome, RoofShape::onion, RoofShape::skillion}) {
      BuildingSizes s = sizes(roof);
      fit_slope(outline, s);
      bool flat = false;
      const auto shell = make_shell(outline, s, flat);
      EXPECT_TRUE(is_closed(shell)) << int(roof) << " " << outline.outer.size();
      for (const city::Polygon& polygon : shell)
        for (const glm::dvec3& p : polygon.exterior)
          EXPECT_TRUE(std::isfinite(p.x + p.y + p.z)) << int(roof);
    }
}

TEST(Roofs, GablesOverAnyOutlineAreClosed) {
  for (int corners = 3; corners < 12; ++corners) {
    Outline outline;
    for (int i = 0; i < corners; ++i) {
      const double t = 2 * std::numbers::pi * i / corners;
      outline.outer.emplace_back(9 * std::cos(t), 4 * std::sin(t) + 0.3 * std::cos(3 * t));
    }
    for (const bool across : {false, true})
      for (const RoofShape roof :
           {RoofShape::gabled, RoofShape::gambrel, RoofShape::round, RoofShape::saltbox,
            RoofShape::half_hipped, RoofShape::mansard, RoofShape::dome, RoofShape::onion}) {
        BuildingSizes s = sizes(roof);
        s.across = across;
        bool flat = false;
        const auto shell = make_shell(outline, s, flat);
        EXPECT_TRUE(is_closed(shell)) << corners;
        EXPECT_GT(shell_volume(shell), 0) << corners;
      }
  }
}

}  // namespace
}  // namespace nightcity::map_buildings
