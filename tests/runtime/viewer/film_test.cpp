// Films that the window begins: the command, its folder, and how far it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "formats/error.h"
#include "runtime/viewer/film_job.h"
#include "runtime/viewer/film_pictures.h"
#include "support/temp_folder.h"

namespace nightcity::viewer {
namespace {

class Film : public testing::Test {
 protected:
  Film() {
    order.program = {"nightview", "record", "--device=cpu"};
    order.scene = "/maps/old town.glb";
    order.path = "/maps/city.path-001.json";
    order.size = {320, 240};
    order.frames = 4;
  }
  static bool has(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  }
  // A film by a shell script, which finds the folder in $1.
  FilmJob begin(const std::string& script, std::uint32_t pictures, double now_s = 0) const {
    FilmPlace place;
    place.folder = folder.path();
    place.film = folder / "film.mp4";
    place.words = {"sh", "-c", script, "sh", folder.path().string()};
    return {place, pictures, now_s};
  }
  static void wait_for_end(FilmJob& job, double now_s) {
    while (!job.has_ended(now_s)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  test::TempFolder folder;
  FilmOrder order;
  ViewerState state;
};

TEST_F(Film, TheCommandHasWhatThePanelShows) {
  state.settings.sampling.estimator = render::Estimator::ris;
  state.settings.sampling.jitter = false;
  state.settings.environment.lights = scene::to_set(LightFamily::window);
  render::set_moon(state.settings.environment, 200, 30, 0.2);
  state.settings.time_s = 11 * 3600;
  state.film = {7.25f, 30};
  auto words = make_film_words(order, state);
  for (const char* word :
       {"/maps/old town.glb", "--path=/maps/city.path-001.json", "--size=320x240", "--frames=4",
        "--duration=7.25", "--fps=30", "--estimator=ris", "--lights=window", "--time=23:00:00",
        "--ev=auto", "--clock-speed=0", "--bounces=0", "--moon=200.0000,30.0000,0.2"})
    EXPECT_TRUE(has(words, word)) << word;
  EXPECT_EQ(words[1], "record");
  EXPECT_EQ(std::count_if(words.begin(), words.end(),
                          [](const std::string& word) { return word.starts_with("--sky="); }),
            1)
      << "without one, record would light the city's own";
  state.play = true;
  state.clock_speed = 60;
  state.auto_exposure = false;
  state.settings.display.ev100 = 3.5f;
  words = make_film_words(order, state);
  EXPECT_TRUE(has(words, "--clock-speed=60"));
  EXPECT_TRUE(has(words, "--ev=3.50"));
}

TEST_F(Film, TheSameFilmGoesOnInItsFolderAndAnotherGetsAnother) {
  const FilmPlace first = prepare_film(folder.path(), order, state);
  EXPECT_EQ(first.folder, folder / "city.path-001");
  EXPECT_EQ(first.film, folder / "city.path-001.mp4");
  EXPECT_TRUE(has(first.words, "--out=" + first.folder.string()));
  EXPECT_NE(test::read_text(first.folder / "command.txt").find("'/maps/old town.glb'"),
            std::string::npos);
  EXPECT_EQ(prepare_film(folder.path(), order, state).folder, first.folder);
  state.settings.sampling.candidates = 7;
  const FilmPlace second = prepare_film(folder.path(), order, state);
  EXPECT_EQ(second.folder, folder / "city.path-001-2");
  order.edits[5].is_off = true;
  const FilmPlace third = prepare_film(folder.path(), order, state);
  EXPECT_EQ(third.folder, folder / "city.path-001-3");
  EXPECT_TRUE(has(third.words, "--edits=" + (third.folder / "edits.json").string()));
  EXPECT_EQ(prepare_film(folder.path(), order, state).folder, third.folder);
  order.edits[5].flux_lm = 30;
  EXPECT_EQ(prepare_film(folder.path(), order, state).folder, folder / "city.path-001-4");
  EXPECT_THROW(prepare_film("/proc/none", order, state), Error);
}

TEST_F(Film, EditsOfTheWindowLieOverOthers) {
  LightEdits all;
  all[1].is_off = true;
  all[2].flux_lm = 10;
  LightEdits own;
  own[2].flux_lm = 20;
  own[2].aim = glm::vec3(0, 0, 1);
  own[3].is_off = true;
  merge_edits(own, all);
  EXPECT_TRUE(all[1].is_off);
  EXPECT_EQ(all[2].flux_lm, 20);
  EXPECT_TRUE(all[2].aim);
  EXPECT_TRUE(all[3].is_off);
}

TEST_F(Film, ItsProgressCountsPicturesAndTheTimeThatIsLeft) {
  FilmJob job = begin("until test -e $1/go; do sleep 0.01; done", 10);
  EXPECT_FALSE(job.has_ended(5));
  EXPECT_EQ(job.progress(5), "filming: picture 1 of 10, begun 5.0 s ago (Esc stops)");
  test::write_text(folder / name_of_picture(0, ".png"), "");
  job.has_ended(100);  // the scene took that long to open
  EXPECT_EQ(job.progress(100), "filming: picture 2 of 10 (Esc stops)");
  for (std::uint32_t i = 1; i < 5; ++i) test::write_text(folder / name_of_picture(i, ".png"), "");
  job.has_ended(112);
  EXPECT_EQ(job.progress(112), "filming: picture 6 of 10, 15 s left (Esc stops)");
  for (std::uint32_t i = 5; i < 10; ++i) test::write_text(folder / name_of_picture(i, ".png"), "");
  EXPECT_FALSE(job.has_ended(120));
  EXPECT_EQ(job.progress(120),
            "filming: 10 pictures are there, making the film of them (Esc stops)");
  test::write_text(folder / "go", "");
  wait_for_end(job, 121);
  EXPECT_NE(job.result().find("film.mp4, of 10 pictures in"), std::string::npos) << job.result();
}

// Pictures of an earlier run count as made, but not in the estimate of the time left.
TEST_F(Film, AnotherRunGoesOnWhereTheFirstEnded) {
  for (std::uint32_t i = 0; i < 6; ++i) test::write_text(folder / name_of_picture(i, ".png"), "");
  FilmJob job = begin("sleep 600", 8);
  EXPECT_EQ(job.progress(1), "filming: picture 7 of 8, begun 1.0 s ago (Esc stops)");
  const std::string sentence = job.stop();
  EXPECT_NE(sentence.find("6 of 8 pictures"), std::string::npos) << sentence;
  wait_for_end(job, 2);
}

TEST_F(Film, WhereItFailsTheReasonIsTheLastLine) {
  FilmJob job = begin(
      "echo first >&2; echo 'nightview: error: ffmpeg is not installed' >&2; echo last; exit 1", 3);
  wait_for_end(job, 1);
  try {
    job.result();
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("0 of 3 pictures are in"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find(": ffmpeg is not installed"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("first"), std::string::npos);
  }
}

}  // namespace
}  // namespace nightcity::viewer
