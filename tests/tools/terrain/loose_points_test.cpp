// Tables of x y z in no order.
#include "tools/terrain/loose_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/temp_folder.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/terrain/open_models.h"

namespace nightcity::terrain {
namespace {

using test::message_of;
using test::TempFolder;
using test::write_text;

struct Point {
  double x, y, z;
};

double find_plane(double x, double y) {
  return 37.5 + 0.5 * x - 0.25 * y;
}

// 21 x 31 points, a metre apart.
std::vector<Point> make_points() {
  std::vector<Point> points;
  for (int y = 0; y <= 30; ++y)
    for (int x = 0; x <= 20; ++x) points.push_back({1000.0 + x, 2000.0 + y, find_plane(x, y)});
  return points;
}

void shuffle(std::vector<Point>& points) {
  std::mt19937 random(7);
  // std::shuffle differs between libraries.
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random() % i]);
}

std::string write(const std::vector<Point>& points, const char* format = "%.3f %.3f %.3f\n") {
  std::string text;
  for (const Point& p : points) {
    char line[160];
    std::snprintf(line, sizeof line, format, p.x, p.y, p.z);
    text += line;
  }
  return text;
}

std::vector<double> read(const std::filesystem::path& file, const std::vector<glm::dvec2>& places) {
  std::vector<double> heights(places.size());
  open_elevation_models({file}, {}).front().sample(places, heights);
  return heights;
}

void expect_plane(const std::filesystem::path& file, const std::string& what) {
  const std::vector<glm::dvec2> places{{1000, 2000}, {1020, 2030},      {1000, 2030},
                                       {1020, 2000}, {1007.25, 2011.5}, {1013, 2029}};
  const std::vector<double> heights = read(file, places);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(heights[i], find_plane(places[i].x - 1000, places[i].y - 2000), 1e-3)
        << what << ", " << i;
  EXPECT_TRUE(std::isnan(read(file, {{998, 2000}})[0])) << what;
}

TEST(LoosePoints, AnyOrderIsTheSameGrid) {
  using Less = std::function<bool(const Point&, const Point&)>;
  const std::pair<const char*, Less> orders[] = {
      {"by height", [](const Point& a, const Point& b) { return a.z < b.z; }},
      {"by easting", [](const Point& a, const Point& b) { return a.x < b.x; }},
      {"snakes",
       [](const Point& a, const Point& b) {
         if (a.y != b.y) return a.y < b.y;
         return static_cast<int>(a.y) % 2 == 0 ? a.x < b.x : a.x > b.x;
       }},
      {"tiles",
       [](const Point& a, const Point& b) {
         const auto tile = [](const Point& p) {
           return std::pair(std::floor((p.x - 1000) / 10), std::floor((p.y - 2000) / 10));
         };
         if (tile(a) != tile(b)) return tile(a) < tile(b);
         return std::pair(a.y, a.x) < std::pair(b.y, b.x);
       }},
      {"diagonals", [](const Point& a, const Point& b) {
         return std::pair(a.x + a.y, a.x) < std::pair(b.x + b.y, b.x);
       }}};
  const TempFolder folder;
  for (const auto& [what, less] : orders) {
    std::vector<Point> points = make_points();
    std::sort(points.begin(), points.end(), less);
    write_text(folder / "a.xyz", write(points));
    expect_plane(folder / "a.xyz", what);
  }
}

TEST(LoosePoints, ColumnsAndSeparatorsAreAsInOrderedTables) {
  std::vector<Point> points = make_points();
  shuffle(points);
  const std::string plain = write(points), commas = write(points, "%.3f,%.3f,%.3f\n");
  std::string german = write(points, "%.3f;%.3f;%.3f\n");
  std::replace(german.begin(), german.end(), '.', ',');
  std::string blanks = plain;
  std::replace(blanks.begin(), blanks.end(), '.', ',');
  std::vector<Point> turned = points;
  for (Point& p : turned) std::swap(p.x, p.y);
  const TempFolder folder;
  const std::pair<const char*, std::string> texts[] = {
      {"plain", plain},
      {"commas", commas},
      {"commas and blanks", write(points, "%.3f, %.3f, %.3f\n")},
      {"tabs", write(points, "%.3f\t%.3f\t%.3f\n")},
      {"semicolons", write(points, "%.3f;%.3f;%.3f\n")},
      {"decimal commas", german},
      {"decimal commas between blanks", blanks},
      {"ends of lines of Windows", write(points, "%.3f %.3f %.3f\r\n")},
      {"blanks before", write(points, "   %.3f   %.3f   %.3f  \n")},
      {"headings", "x,y,z\n" + commas},
      {"headings in another order", "Northing Easting Height\n" + write(turned)},
      {"a comment that is headings", "# DGM\n# y x z\n" + write(turned)},
      {"more columns", write(points, "%.3f %.3f %.3f 7 8\n")},
      {"exponents", write(points, "%.9e %.9e %.9e\n")},
      {"twice the same", plain + plain}};
  for (const auto& [what, text] : texts) {
    write_text(folder / "a.xyz", text);
    expect_plane(folder / "a.xyz", what);
  }
}

TEST(LoosePoints, WhatIsMissingIsAHole) {
  std::vector<Point> points = make_points();
  std::erase_if(points, [](const Point& p) { return p.x == 1010 && p.y == 2010; });
  for (Point& p : points)
    if (p.x == 1004 && p.y == 2004) p.z = -9999;
  shuffle(points);
  const TempFolder folder;
  write_text(folder / "a.xyz", write(points));
  expect_plane(folder / "a.xyz", "holes");
  for (const double height : read(folder / "a.xyz", {{1010, 2010}, {1004, 2004}, {1009.5, 2010.5}}))
    EXPECT_TRUE(std::isnan(height));
  EXPECT_NEAR(read(folder / "a.xyz", {{1011, 2010}})[0], find_plane(11, 10), 1e-3);
}

TEST(LoosePoints, DegreesThatAreRoundedLieOnTheirGrid) {
  std::vector<Point> points;
  constexpr double step = 1.0 / 3600;
  for (int y = 0; y <= 40; ++y)
    for (int x = 0; x <= 40; ++x)
      points.push_back({13 + x * step, 52 + y * step, 20.0 + x + 2 * y});
  shuffle(points);
  const TempFolder folder;
  write_text(folder / "a.xyz", write(points, "%.6f %.6f %.2f\n"));
  std::vector<double> heights(1);
  const glm::dvec2 place(13 + 7.5 * step, 52 + 33.25 * step);
  open_elevation_models({folder / "a.xyz"}, {.crs_without = "EPSG:4326"})
      .front()
      .sample(std::span(&place, 1), heights);
  EXPECT_NEAR(heights[0], 20 + 7.5 + 66.5, 0.01);
}

TEST(LoosePoints, WhatLiesOnNoGridIsTold) {
  const TempFolder folder;
  const auto refuse = [&](const std::vector<Point>& points) {
    write_text(folder / "a.xyz", write(points));
    return message_of([&] { open_elevation_models({folder / "a.xyz"}, {}); });
  };
  std::vector<Point> scattered = make_points(), line, turned = make_points(), two = make_points();
  std::mt19937 random(5);
  for (Point& p : scattered) p.x += 0.4 * static_cast<double>(random() % 1000) / 1000;
  for (int i = 0; i < 200; ++i) line.push_back({1000.0 + i, 2000.0 + (i * 7) % 200, 5});
  for (Point& p : turned) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
  two.push_back({1003, 2003, 99});
  for (std::vector<Point>* points : {&scattered, &line, &turned, &two}) shuffle(*points);
  for (const auto* points : {&scattered, &line, &turned})
    EXPECT_NE(refuse(*points).find("its points stand on no grid"), std::string::npos);
  EXPECT_NE(refuse(two).find("two heights in one place, at 1003 2003"), std::string::npos);
}

TEST(LoosePoints, NoMoreThanTheLimitAreHeld) {
  std::vector<Point> points = make_points();
  shuffle(points);
  const TempFolder folder;
  write_text(folder / "a.xyz", write(points));
  const std::string path = (folder / "a.xyz").string();
  gdal::register_drivers();
  EXPECT_TRUE(grid_loose_points(path, "a.xyz", points.size()));
  EXPECT_NE(message_of([&] {
              grid_loose_points(path, "a.xyz", points.size() - 1);
            }).find("a.xyz: has more than 650 points in no order"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity::terrain
