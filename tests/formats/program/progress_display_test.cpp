#include "formats/program/progress_display.h"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

namespace nightcity::program {
namespace {

using namespace std::chrono_literals;

// A display whose clock the test sets and whose output it reads.
struct Watched {
  std::vector<std::string> written, logged;
  ProgressDisplay::Clock::time_point now{};

  ProgressDisplay::Output make_output(bool is_terminal) {
    return {is_terminal, [this](const std::string& text) { written.push_back(text); },
            [this](const std::string& message) { logged.push_back(message); },
            [this] { return now; }};
  }
};

const std::string erase = "\r\033[K";

TEST(FormatDuration, UsesTwoUnitsAtMost) {
  EXPECT_EQ(format_duration(0s), "0.0 s");
  EXPECT_EQ(format_duration(3200ms), "3.2 s");
  EXPECT_EQ(format_duration(9960ms), "10 s");
  EXPECT_EQ(format_duration(59600ms), "1 min 0 s");
  EXPECT_EQ(format_duration(250s), "4 min 10 s");
  EXPECT_EQ(format_duration(7500s), "2 h 5 min");
}

TEST(ProgressDisplay, SaysHowLongTheRestTakes) {
  Watched watched;
  ProgressDisplay display(watched.make_output(true));
  display.show({"rendering", 0, 40, "frames"});
  watched.now += 20s;
  display.show({"rendering", 10, 40, "frames"});
  EXPECT_EQ(watched.written, (std::vector<std::string>{
                                 erase + "rendering, 0/40 frames",
                                 erase + "rendering, 10/40 frames, 1 min 0 s left",
                             }));
}

TEST(ProgressDisplay, EstimatesEachPieceOfWorkByItself) {
  Watched watched;
  ProgressDisplay display(watched.make_output(true));
  display.show({"reading", 0, 10, "files"});
  watched.now += 100s;
  display.show({"writing", 0, 20, "tiles"});
  watched.now += 1s;
  display.show({"writing", 10, 20, "tiles"});
  EXPECT_EQ(watched.written.back(), erase + "writing, 10/20 tiles, 1.0 s left");
}

TEST(ProgressDisplay, CountsWithoutATotal) {
  Watched watched;
  ProgressDisplay display(watched.make_output(true));
  display.show({"reading a.gml", 0, 0, "objects"});
  watched.now += 1s;
  display.show({"reading a.gml", 512, 0, "objects"});
  EXPECT_EQ(watched.written, (std::vector<std::string>{erase + "reading a.gml",
                                                       erase + "reading a.gml, 512 objects"}));
}

TEST(ProgressDisplay, RedrawsTenTimesASecondAtMostButShowsTheEnd) {
  Watched watched;
  ProgressDisplay display(watched.make_output(true));
  for (std::uint64_t i = 0; i <= 1000; ++i) {
    display.show({"rendering", i, 1000, "frames"});
    watched.now += 1ms;
  }
  EXPECT_LE(watched.written.size(), 12u);
  EXPECT_EQ(watched.written.back(), erase + "rendering, 1000/1000 frames");
}

TEST(ProgressDisplay, ErasesItsLine) {
  Watched watched;
  {
    ProgressDisplay display(watched.make_output(true));
    display.show({"reading", 0, 0, ""});
    display.clear();
    display.clear();
    EXPECT_EQ(watched.written.size(), 2u) << "there is nothing left to erase";
    display.show({"reading", 0, 0, ""});
    EXPECT_EQ(watched.written.size(), 3u) << "it is drawn again at once";
  }
  EXPECT_EQ(watched.written.size(), 4u);
  EXPECT_EQ(watched.written.back(), erase);
}

TEST(ProgressDisplay, WritesSparseMessagesWhereThereIsNoTerminal) {
  Watched watched;
  {
    ProgressDisplay display(watched.make_output(false));
    for (std::uint64_t i = 0; i <= 100; ++i) {
      display.show({"rendering", i, 100, "frames"});
      watched.now += 1s;
    }
  }
  EXPECT_TRUE(watched.written.empty());
  EXPECT_EQ(watched.logged, (std::vector<std::string>{"rendering, 30/100 frames, 1 min 10 s left",
                                                      "rendering, 60/100 frames, 40 s left",
                                                      "rendering, 90/100 frames, 10 s left"}));
}

}  // namespace
}  // namespace nightcity::program
