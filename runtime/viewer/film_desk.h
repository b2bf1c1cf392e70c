// Records the way of the camera, and films it.
#pragma once

#include <memory>
#include <string>

#include "runtime/viewer/film_job.h"
#include "runtime/viewer/path_recorder.h"
#include "runtime/viewer/session.h"
#include "runtime/viewer/viewer.h"

namespace nightcity::viewer {

class FilmDesk {
 public:
  /// Both must outlive the object.
  FilmDesk(const ViewOptions& options, Session& session) : options_(options), session_(session) {}

  /// Forgets the path of the city before.
  void open() { recorder_ = {}; }
  /// Begins to record the camera's way, or ends that.
  void toggle_path(const std::string& city, double now_s);
  /// Keeps the camera's pose while its way is recorded.
  void follow(double now_s) { recorder_.follow(session_.state.camera.pose, now_s); }

  /// Begins to film the last path, else the bookmarks, of that city with its lights as edited, or
  /// says why not.
  void begin(const std::string& city, const LightEdits& edits, glm::uvec2 window, double now_s);
  bool films() const { return job_ != nullptr; }
  void stop(double now_s);
  /// Looks how far the film is. Returns whether it has ended, and says how.
  bool look(double now_s);
  /// Returns how far it is, in words; "" without one.
  std::string progress(double now_s) const { return job_ ? job_->progress(now_s) : ""; }

 private:
  std::filesystem::path find_path(const std::filesystem::path& scene, double now_s);

  const ViewOptions& options_;
  Session& session_;
  PathRecorder recorder_;
  std::unique_ptr<FilmJob> job_;
  std::unique_ptr<FilmJob> stopped_;  // until it has ended: nobody waits for it
};

}  // namespace nightcity::viewer
