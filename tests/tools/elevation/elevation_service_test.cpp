// Against a stand-in on this machine: what is asked, how often, and which answers are believed.
#include "tools/elevation/elevation_service.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/elevation/stand_in.h"

namespace nightcity::elevation {
namespace {

using test::StandIn;

std::vector<glm::dvec2> places(std::size_t count) {
  std::vector<glm::dvec2> result;
  for (std::size_t n = 0; n < count; ++n)
    result.emplace_back(13.0 + 0.001 * static_cast<double>(n), 52.5);
  return result;
}

/// Answers 30 m, and a metre more for each place to the east.
nlohmann::json slope(double, double lon) {
  return 30 + std::round((lon - 13) * 1000);
}

ElevationServiceOptions quick(const StandIn& server) {
  ElevationServiceOptions options;
  options.url = server.url();
  options.batch = 10;
  options.first_wait = std::chrono::milliseconds(1);
  return options;
}

TEST(ElevationService, PlacesAreAskedInBatchesAndAnswersKeepTheirOrder) {
  const StandIn server([](const std::string& body) { return StandIn::heights(body, slope); });
  const auto answers = ask_elevations(places(25), quick(server));
  ASSERT_EQ(answers.heights.size(), 25u);
  for (std::size_t n = 0; n < 25; ++n) EXPECT_EQ(answers.heights[n], 30.0 + static_cast<double>(n));
  EXPECT_EQ(answers.requests, 3u);
  EXPECT_EQ(nlohmann::json::parse(server.requests().at(2))["locations"].size(), 5u);
}

TEST(ElevationService, ABusyServiceIsAskedAgainAndThenGivenUp) {
  for (const int status : {429, 503, 504}) {
    std::atomic<int> calls = 0;
    const StandIn server([&](const std::string& body) {
      return ++calls <= 3 ? StandIn::Reply{status, "busy", "Retry-After: 0\r\n"}
                          : StandIn::heights(body, slope);
    });
    const auto answers = ask_elevations(places(3), quick(server));
    EXPECT_EQ(answers.heights[2], 32.0);
    EXPECT_EQ(answers.retries, 3u);
    EXPECT_EQ(answers.requests, 4u);
  }
  const StandIn never([](const std::string&) { return StandIn::Reply{429, "", ""}; });
  auto options = quick(never);
  options.attempts = 3;
  EXPECT_THROW(ask_elevations(places(1), options), Error);
  EXPECT_EQ(never.requests().size(), 3u);
}

TEST(ElevationService, APauseTheServiceAsksForIsCutToTheLongestWait) {
  std::atomic<int> calls = 0;
  const StandIn server([&](const std::string& body) {
    return ++calls <= 2 ? StandIn::Reply{429, "", "Retry-After: 1\r\n"}
                        : StandIn::heights(body, slope);
  });
  auto options = quick(server);
  options.max_wait = std::chrono::seconds(0);  // no test waits: a longer pause is cut to this
  EXPECT_EQ(ask_elevations(places(1), options).retries, 2u);
}

TEST(ElevationService, WhatWasAskedOnceIsNotAskedAgain) {
  const test::TempFolder folder;
  const StandIn server([](const std::string& body) { return StandIn::heights(body, slope); });
  auto options = quick(server);
  options.cache = folder / "heights";
  ask_elevations(places(12), options);
  test::write_text(folder / "heights",
                   test::read_text(folder / "heights") + "broken line\n\n\t\t\n");
  const auto answers = ask_elevations(places(15), options);
  EXPECT_EQ(answers.from_cache, 12u);
  EXPECT_EQ(answers.requests, 1u);
  for (std::size_t n = 0; n < 15; ++n) EXPECT_EQ(answers.heights[n], 30.0 + static_cast<double>(n));
  EXPECT_EQ(server.requests().size(), 3u);
}

TEST(ElevationService, WhatWasToldBeforeAFailureIsKept) {
  const test::TempFolder folder;
  std::atomic<int> calls = 0;
  const StandIn server([&](const std::string& body) {
    return ++calls == 2 ? StandIn::Reply{500, "", ""} : StandIn::heights(body, slope);
  });
  auto options = quick(server);
  options.cache = folder / "heights";
  EXPECT_THROW(ask_elevations(places(20), options), Error);
  EXPECT_EQ(ask_elevations(places(20), options).from_cache, 10u);
}

TEST(ElevationService, ZeroIsNoHeightAmongHills) {
  const StandIn server([](const std::string& body) {
    return StandIn::heights(body, [](double, double lon) -> nlohmann::json {
      const double height = std::round((lon - 13) * 1000);  // 0 at the first place
      return height == 0 || height == 7 ? 0.0 : 100 + height;
    });
  });
  const auto answers = ask_elevations(places(10), quick(server));
  EXPECT_EQ(answers.zeros_refused, 2u);
  EXPECT_FALSE(answers.heights[0]);
  EXPECT_FALSE(answers.heights[7]);
  EXPECT_EQ(answers.heights[3], 103.0);
}

TEST(ElevationService, ZeroIsAHeightByTheSeaAndNoneWhereAllIsZero) {
  const StandIn sea([](const std::string& body) {
    return StandIn::heights(body, [](double, double lon) -> nlohmann::json {
      return std::fmod(std::round((lon - 13) * 1000), 3.0) - 1;  // -1, 0, 1
    });
  });
  const auto coast = ask_elevations(places(9), quick(sea));
  EXPECT_EQ(coast.zeros_refused, 0u);
  EXPECT_EQ(coast.heights[1], 0.0);
  const StandIn nothing([](const std::string& body) {
    return StandIn::heights(body, [](double, double) -> nlohmann::json { return 0; });
  });
  EXPECT_EQ(ask_elevations(places(9), quick(nothing)).zeros_refused, 9u);
}

TEST(ElevationService, NullAndImpossibleHeightsAreNoData) {
  const StandIn server([](const std::string& body) {
    return StandIn::heights(body, [](double, double lon) -> nlohmann::json {
      if (lon < 13.0005) return nullptr;
      return lon < 13.0015 ? -32768.0 : 40.0;
    });
  });
  const auto answers = ask_elevations(places(3), quick(server));
  EXPECT_FALSE(answers.heights[0]);
  EXPECT_FALSE(answers.heights[1]);
  EXPECT_EQ(answers.heights[2], 40.0);
}

TEST(ElevationService, NonsenseIsAnErrorThatNamesTheService) {
  for (const char* body :
       {"", "null", "[]", "{}", "{\"results\": 3}", "{\"results\": []}",
        "{\"results\": [{\"elevation\": \"high\"}]}", "{\"results\": [7]}", "<html>"}) {
    const StandIn server([body](const std::string&) { return StandIn::Reply{200, body, ""}; });
    try {
      ask_elevations(places(1), quick(server));
      ADD_FAILURE() << body;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(server.url()), std::string::npos) << error.what();
    }
  }
  ElevationServiceOptions options;
  options.url = "file:///etc/hostname";  // only the web may be asked
  EXPECT_THROW(ask_elevations(places(1), options), Error);
  options.url = "http://127.0.0.1:1/";
  EXPECT_THROW(ask_elevations(places(1), options), Error);
}

}  // namespace
}  // namespace nightcity::elevation
