#include "runtime/viewer/film_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "formats/error.h"
#include "formats/program/progress_display.h"
#include "runtime/viewer/film_pictures.h"

namespace nightcity::viewer {
namespace {

// Returns the last line of a program's messages, which says why it ended, without its name.
std::string find_last_line(const std::string& text) {
  const std::size_t last = text.find_last_not_of("\r\n ");
  if (last == std::string::npos) return "it said nothing";
  const std::size_t break_before = text.find_last_of("\r\n", last);
  const std::size_t first = break_before == std::string::npos ? 0 : break_before + 1;
  const std::string line = text.substr(first, last + 1 - first), mark = "error: ";
  const std::size_t error = line.find(mark);
  return error == std::string::npos ? line : line.substr(error + mark.size());
}

}  // namespace

FilmJob::FilmJob(const FilmPlace& place, std::uint32_t pictures, double now_s)
    : place_(place),
      pictures_(pictures),
      begun_with_(count_present(place.folder, 0, pictures)),
      done_(begun_with_),
      start_s_(now_s),
      child_(place.words) {}

bool FilmJob::has_ended(double now_s) {
  const std::uint32_t before = done_;
  done_ += count_present(place_.folder, done_, pictures_);
  if (before == begun_with_ && done_ > before) first_s_ = now_s;
  const std::optional<int> status = child_.find_status();
  if (status) status_ = *status;
  return status.has_value();
}

std::string FilmJob::progress(double now_s) const {
  const auto duration = [](double seconds) {
    return program::format_duration(std::chrono::duration<double>(seconds));
  };
  std::string text =
      fmt::format("filming: picture {} of {}", std::min(done_ + 1, pictures_), pictures_);
  if (done_ == pictures_)
    text = fmt::format("filming: {} pictures are there, making the film of them", pictures_);
  else if (done_ == begun_with_)
    text += fmt::format(", begun {} ago", duration(now_s - start_s_));
  else if (done_ > begun_with_ + 1)  // the first had the scene to open
    text += fmt::format(", {} left", duration((now_s - first_s_) / (done_ - begun_with_ - 1) *
                                              (pictures_ - done_)));
  return text + " (Esc stops)";
}

std::string FilmJob::stop() {
  child_.stop();
  return fmt::format(
      "the film is stopped: {} of {} pictures are in {}, and the same film goes on "
      "from there",
      done_, pictures_, place_.folder.string());
}

std::string FilmJob::result() const {
  if (status_ != 0)
    throw Error("film",
                fmt::format("{} of {} pictures are in {}: {}", done_, pictures_,
                            place_.folder.string(), find_last_line(child_.read_messages())));
  return fmt::format("filmed: {}, of {} pictures in {}", place_.film.string(), pictures_,
                     place_.folder.string());
}

}  // namespace nightcity::viewer
