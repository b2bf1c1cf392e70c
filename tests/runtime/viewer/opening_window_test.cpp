// The window while its scene is opened, in this process: the test decides when the scene is there.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include "formats/cancel.h"
#include "formats/parallel.h"
#include "formats/program/child_program.h"
#include "runtime/viewer/viewer.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::viewer {
namespace {

using namespace std::chrono_literals;

bool has_program(const char* program) {
  return std::system((std::string("command -v ") + program + " > /dev/null 2>&1").c_str()) == 0;
}

// A virtual display of its own.
class Display {
 public:
  Display()
      : server_({"Xvfb", "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"}) {
    for (int i = 0; i < 3000 && number().empty(); ++i) std::this_thread::sleep_for(10ms);
    ::setenv("DISPLAY", (":" + number()).c_str(), 1);
  }
  ~Display() { ::unsetenv("DISPLAY"); }

  // The number is a line of its own, among whatever the server says.
  std::string number() {
    const std::string said = server_.read_output();
    for (std::size_t from = 0, to; (to = said.find('\n', from)) != std::string::npos;
         from = to + 1) {
      const std::string line = said.substr(from, to - from);
      if (!line.empty() && line.find_first_not_of("0123456789") == std::string::npos) return line;
    }
    return "";
  }

 private:
  program::ChildProgram server_;
};

// Keys are pressed while the scene cannot be there: it is let in when they were obeyed.
TEST(OpeningWindow, KeysThatNeedNoSceneAreObeyed) {
  if (!has_program("Xvfb") || !has_program("xdotool"))
    GTEST_SKIP() << "Xvfb or xdotool is not installed: no display or no keyboard";
  const test::TempFolder folder;
  Display display;
  ASSERT_NE(display.number(), "");
  std::atomic<bool> may_open = false;
  ViewOptions options;
  options.scenes = {(folder / "town.glb").string()};
  options.load = [&](const std::string&) {
    while (!may_open) std::this_thread::sleep_for(5ms);
    return test::SceneBuilder().ground(20).with({test::lamp({0, 5, 0}, 1000)});
  };
  options.camera = "overview";
  options.device.validation = true;
  options.width = 320;
  options.height = 240;
  options.settings_file = folder / "settings.toml";
  options.picture_folder = folder.path();
  std::thread hands([&] {
    const auto run = [](const std::string& command) { return std::system(command.c_str()); };
    run("xdotool search --sync --onlyvisible --name nightview > /dev/null 2>&1");
    run("xdotool mousemove 300 220 key 2 key p key v key ctrl+s");
    for (int i = 0; i < 3000 && !std::filesystem::exists(options.settings_file); ++i)
      std::this_thread::sleep_for(10ms);
    run("xdotool key F1 key Escape key Escape");  // the first closes the list of keys
    may_open = true;
  });
  const ViewReport report = run_viewer(options);
  hands.join();
  const std::string settings = test::read_text(options.settings_file);
  EXPECT_NE(settings.find("estimator = 'ris'"), std::string::npos) << settings;
  EXPECT_NE(settings.find("show = 'luminance'"), std::string::npos) << settings;
  EXPECT_EQ(report.estimator, "ris");
  EXPECT_FALSE(std::filesystem::exists(folder / "night-001.png")) << "P needs the scene";
}

// Loading ends only when it is told to: by the two keys or the signal, through the window's loop.
TEST(OpeningWindow, ClosingItEndsTheLoading) {
  if (!has_program("Xvfb") || !has_program("xdotool"))
    GTEST_SKIP() << "Xvfb or xdotool is not installed: no display or no keyboard";
  const test::TempFolder folder;
  Display display;
  ASSERT_NE(display.number(), "");
  for (const bool by_signal : {false, true}) {
    std::atomic<bool> was_cancelled = false;
    ViewOptions options;
    options.scenes = {(folder / "town.glb").string()};
    options.load = [&](const std::string&) {
      const auto end = std::chrono::steady_clock::now() + 60s;
      try {
        while (std::chrono::steady_clock::now() < end)
          run_parallel(8, 2, [](std::size_t) { std::this_thread::sleep_for(5ms); });
      } catch (const Cancelled&) {
        was_cancelled = true;
        throw;
      }
      return test::SceneBuilder().ground(20).with({test::lamp({0, 5, 0}, 1000)});
    };
    options.camera = "overview";
    options.width = 320;
    options.height = 240;
    std::chrono::steady_clock::time_point asked;
    std::thread hands([&] {
      const auto run = [](const std::string& command) { return std::system(command.c_str()); };
      run("xdotool search --sync --onlyvisible --name nightview > /dev/null 2>&1");
      std::this_thread::sleep_for(500ms);
      asked = std::chrono::steady_clock::now();
      if (by_signal)
        std::raise(SIGTERM);
      else
        run("xdotool mousemove 300 220 key Escape");
    });
    const ViewReport report = run_viewer(options);
    const auto closed = std::chrono::steady_clock::now();
    hands.join();
    EXPECT_TRUE(was_cancelled);
    EXPECT_LT(closed - asked, 10s);
    EXPECT_EQ(report.closing_signal, by_signal ? SIGTERM : 0);
    EXPECT_EQ(report.shown, 0u);
  }
}

}  // namespace
}  // namespace nightcity::viewer
