#include "tools/bake/report/report_text.h"

#include <gtest/gtest.h>

#include "formats/median.h"
#include "tools/bake/report/bake_report.h"

namespace nightcity::bake {
namespace {

TEST(ReportText, CountsAreListedByFrequency) {
  EXPECT_EQ(in_words({}), "none");
  EXPECT_EQ(in_words({{"roof", 3}, {"wall", 12}, {"door", 3}}), "12 wall, 3 door, 3 roof");
  EXPECT_EQ(report_line("city", "x"), "city        x\n");
}

TEST(BakeReport, WhatIsLeftOutComesFromEveryPartOfIt) {
  BakeReport report;
  report.city.left_out["far from the city"] = 1;
  report.tiles.left_out["triangles between two buildings"] = 2;
  EXPECT_EQ(report.left_out().size(), 2u);
  report.ground.lone_vertices = 3;
  EXPECT_EQ(report.left_out().at("break lines of which the vertices alone are used"), 3u);
}

TEST(Median, IsTheGreaterOfTheTwoMiddleValues) {
  EXPECT_EQ(median(std::vector<double>{}, -1.0), -1);
  EXPECT_EQ(median(std::vector<double>{5}), 5);
  EXPECT_EQ(median(std::vector<double>{9, 1, 5}), 5);
  EXPECT_EQ(median(std::vector<int>{4, 1, 3, 2}), 3);
}

}  // namespace
}  // namespace nightcity::bake
