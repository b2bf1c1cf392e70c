#include "runtime/viewer/film_desk.h"

#include <algorithm>
#include <filesystem>

#include "formats/error.h"
#include "runtime/scene/scene_file.h"
#include "runtime/viewer/errand.h"
#include "runtime/viewer/film_pictures.h"
#include "runtime/viewer/picture_names.h"

namespace nightcity::viewer {

namespace fs = std::filesystem;

void FilmDesk::toggle_path(const std::string& city, double now_s) {
  run_errand(session_.notices, now_s, [&] {
    const std::string sentence = recorder_.toggle(scene::find_scene_file(city), now_s);
    if (!recorder_.is_recording())
      session_.state.film.duration_s = static_cast<float>(recorder_.duration_s());
    return sentence;
  });
}

// A path that is being recorded ends here.
fs::path FilmDesk::find_path(const fs::path& scene, double now_s) {
  if (recorder_.is_recording()) {
    session_.notices.say(recorder_.finish(scene), now_s);
    session_.state.film.duration_s = static_cast<float>(recorder_.duration_s());
  }
  if (!recorder_.file().empty()) return recorder_.file();
  if (session_.count_bookmarks() >= 2) return session_.bookmark_file();
  throw Error("film", "there is no path yet: R records the camera's way, or B sets two bookmarks");
}

void FilmDesk::begin(const std::string& city, const LightEdits& edits, glm::uvec2 window,
                     double now_s) {
  if (job_) {
    session_.notices.say("a film is being recorded already", now_s);
    return;
  }
  run_errand(session_.notices, now_s, [&] {
    const ViewerState& state = session_.state;
    FilmOrder order;
    order.program = options_.record_command;
    order.scene = fs::absolute(scene::find_scene_file(city));
    order.path = fs::absolute(find_path(order.scene, now_s));
    order.size = window;
    if (options_.picture.width > 0) order.size = {options_.picture.width, options_.picture.height};
    order.frames = options_.picture.frames;
    if (!options_.edits.empty()) order.edits = read_light_edits(options_.edits);
    merge_edits(edits, order.edits);
    const FilmPlace place =
        prepare_film(fs::absolute(find_picture_folder(options_.picture_folder)), order, state);
    job_ = std::make_unique<FilmJob>(
        place, count_pictures(double(state.film.duration_s), double(state.film.pictures_per_s)),
        now_s);
    return "filming into " + place.folder.string();
  });
}

void FilmDesk::stop(double now_s) {
  if (!job_) return;
  session_.notices.say(job_->stop(), now_s);
  stopped_ = std::move(job_);
}

bool FilmDesk::look(double now_s) {
  if (stopped_ && stopped_->has_ended(now_s)) stopped_.reset();
  if (!job_ || !job_->has_ended(now_s)) return false;
  const std::unique_ptr<FilmJob> ended = std::move(job_);
  run_errand(session_.notices, now_s, [&] { return ended->result(); });
  return true;
}

}  // namespace nightcity::viewer
