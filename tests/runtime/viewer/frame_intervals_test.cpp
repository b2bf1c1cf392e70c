// The times between pictures in motion: which are counted, and the shares of a known list.
#include "runtime/viewer/frame_intervals.h"

#include <gtest/gtest.h>

namespace nightcity::viewer {
namespace {

TEST(FrameIntervals, DescribesTheQuantilesOfAKnownList) {
  FrameIntervals intervals;
  double now_s = 5;
  intervals.add(now_s, true);
  EXPECT_EQ(intervals.describe(), "");
  for (int i = 1; i <= 200; ++i) intervals.add(now_s += i / 1000.0, true);  // 1 to 200 ms
  EXPECT_EQ(intervals.describe(),
            "200 intervals, 100.0 ms in the median, 99 % within 198.0 ms, all within 200.0 ms");
}

TEST(FrameIntervals, CountsOnlyPicturesThatFollowEachOtherInMotion) {
  FrameIntervals intervals;
  intervals.add(0, true);
  intervals.add(10, false);  // the view came to rest
  intervals.add(20, true);   // and moves again
  EXPECT_EQ(intervals.count(), 0u);
  intervals.add(20.5, true);
  EXPECT_EQ(intervals.count(), 1u);
  EXPECT_EQ(intervals.describe(),
            "1 interval, 500.0 ms in the median, 99 % within 500.0 ms, all within 500.0 ms");
}

TEST(FrameIntervals, ForgetsTheOldest) {
  FrameIntervals intervals;
  double now_s = 0;
  intervals.add(now_s, true);
  for (std::size_t i = 0; i < 3; ++i) intervals.add(now_s += 9, true);
  for (std::size_t i = 0; i < FrameIntervals::most; ++i) intervals.add(now_s += 0.25, true);
  EXPECT_NE(intervals.describe().find("all within 250.0 ms"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::viewer
