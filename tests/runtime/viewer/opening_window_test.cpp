// The window while its scene is opened, in this process: the test decides when the scene is there.
#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "formats/cancel.h"
#include "formats/parallel.h"
#include "formats/program/child_program.h"
#include "runtime/scene/scene_traits.h"
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
      : server_({"Xvfb", "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp",
                 // It would begin anew when its last client goes, and refuse the next meanwhile.
                 "-noreset"}) {
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
  options.load = [&](const std::string&, const scene::TakeTraits&) {
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
  EXPECT_NE(settings.find("estimator = \"ris\""), std::string::npos) << settings;
  EXPECT_NE(settings.find("show = \"luminance\""), std::string::npos) << settings;
  EXPECT_EQ(report.estimator, "ris");
  EXPECT_FALSE(std::filesystem::exists(folder / "night-001.png")) << "P needs the scene";
}

// Keeps what is logged, in order.
class Lines : public spdlog::sinks::base_sink<std::mutex> {
 public:
  Lines() : before_(spdlog::default_logger()) { set_pattern("%v"); }
  // Returns the place of the first line that contains `text`, SIZE_MAX without one.
  std::size_t find(const std::string& text) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].find(text) != std::string::npos) return i;
    return SIZE_MAX;
  }
  std::string all() {
    const std::lock_guard lock(mutex_);
    std::string text;
    for (const std::string& line : lines_) text += line;
    return text;
  }
  void restore() { spdlog::set_default_logger(before_); }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t text;
    formatter_->format(message, text);
    lines_.emplace_back(text.data(), text.size());
  }
  void flush_() override {}

  std::shared_ptr<spdlog::logger> before_;
  std::vector<std::string> lines_;
};

// The scene arrives only when the passes of its first picture are compiled, which takes as long as
// it takes. On a CPU driver that is a draft, and the other passes are compiled when it is there.
TEST(OpeningWindow, PassesOfTheFirstPictureAreCompiledWhileTheSceneIsRead) {
  if (!has_program("Xvfb")) GTEST_SKIP() << "Xvfb is not installed: no display";
  const test::TempFolder folder;
  Display display;
  ASSERT_NE(display.number(), "");
  const auto lines = std::make_shared<Lines>();
  const auto logger = std::make_shared<spdlog::logger>("test", lines);
  logger->set_level(spdlog::level::debug);
  spdlog::set_default_logger(logger);
  ViewOptions options;
  options.scenes = {(folder / "town.glb").string()};
  bool in_time = false;
  options.load = [&](const std::string&, const scene::TakeTraits& take) {
    scene::RenderScene scene = test::SceneBuilder().ground(20).with({test::lamp({0, 5, 0}, 1000)});
    take(scene::find_traits(scene));
    const auto compiled = [&] {
      return lines->find("the passes of a draft are compiled") != SIZE_MAX ||
             lines->find("the passes of frames are compiled") != SIZE_MAX;
    };
    for (int i = 0; i < 6000 && !compiled(); ++i) std::this_thread::sleep_for(10ms);
    in_time = compiled();
    return scene;
  };
  options.camera = "overview";
  options.device.validation = true;
  options.width = 320;
  options.height = 240;
  options.quit_after = 1;
  const ViewReport report = run_viewer(options);
  lines->restore();
  EXPECT_TRUE(in_time) << lines->all();
  EXPECT_EQ(report.shown, 1u) << "a draft is not counted";
  const std::size_t draft = lines->find("the passes of a draft are compiled"),
                    opened = lines->find("is opened"), shown = lines->find("the first draft is"),
                    rest = lines->find("the passes of frames are compiled"),
                    picture = lines->find("the first picture is shown");
  ASSERT_NE(opened, SIZE_MAX);
  if (draft == SIZE_MAX) {  // on a GPU
    EXPECT_LT(rest, opened) << lines->all();
    EXPECT_EQ(shown, SIZE_MAX);
  } else {
    EXPECT_LT(draft, opened) << lines->all();
    EXPECT_LT(opened, shown);
    EXPECT_LT(shown, rest);
  }
  EXPECT_LT(rest, picture);
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
    options.load = [&](const std::string&, const scene::TakeTraits&) {
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
