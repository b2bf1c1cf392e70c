// The workbench holds the city that is shown, its picture, a picture that is being saved, and a
// city that is being opened.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "runtime/render/pass_library.h"
#include "runtime/viewer/city.h"
#include "runtime/viewer/live_picture.h"
#include "runtime/viewer/picture_job.h"

namespace nightcity::viewer {

/// The views that the pictures are to show.
struct Views {
  View view;
  std::optional<View> other;  // of the second picture, if there is one
  // Both need the same lights to shine. If not, one is rendered after the other, since each change
  // of lights takes a moment.
  bool same_lights = true;
};

/// The workbench holds one of these beside the picture.
enum class Beside {
  nothing,
  side,      // of a comparison
  reference  // the same picture by the reference estimator, for VIEW_DIFFERENCE
};

class Workbench {
 public:
  /// The device must outlive the object.
  explicit Workbench(gpu::Device& device) : device_(device), passes_(device, kept_sets) {}

  /// Takes a city that is being read, unless another one is.
  void open(std::unique_ptr<Opening> opening);
  const Opening* opening() const { return opening_.get(); }
  /// Takes the place of the city that is shown, once the one that is being opened is there. Returns
  /// whether it did. Throws what opening threw.
  bool finish_opening(glm::uvec2 window);

  bool has_city() const { return city_ != nullptr; }
  const City& city() const { return *city_; }
  City& city() { return *city_; }
  /// Returns the picture of the city, null without one.
  LivePicture* picture() { return picture_.get(); }
  const LivePicture* picture() const { return picture_.get(); }

  /// Holds a second picture of the city, for work() to render another view, or none.
  void hold_beside(Beside what);
  /// Returns the second picture where it is of this kind, else null.
  const LivePicture* beside(Beside what) const { return what == beside_ ? other_.get() : nullptr; }
  /// Shows the last pictures with these settings of the display. Not while picture() is busy.
  void expose(const render::DisplaySettings& display);
  /// Exchanges the two pictures: their views are going to be exchanged.
  void exchange() { std::swap(picture_, other_); }

  /// Renders the view to be saved.
  void save(const View& view, const PictureQuality& quality);
  bool is_saving() const { return job_ != nullptr; }
  void stop_saving() { job_.reset(); }
  /// Returns the picture that is complete after Result::saved, with its info, shown as these
  /// settings say. Throws Error.
  SavedPicture take_saved(const render::DisplaySettings& display);

  /// Returns whether a slice runs on the device, or the device translates a pass: showing a picture
  /// would wait for it.
  bool is_busy() const;
  bool translates() const { return passes_.is_busy(); }
  /// Waits at most `wait_s` for the slice that runs, and returns whether none does.
  bool wait(double wait_s);
  /// Returns whether work() would do something.
  bool has_work(const Views& views, double now_s) const;

  enum class Result { nothing, picture, saved };
  /// Works a slice. A picture that is saved goes on only while the view rests (`still`), and the
  /// window shows it. Returns what is complete: nothing, a new frame of the picture, or the picture
  /// to be saved.
  Result work(const Views& views, bool still, double now_s, double wait_s);
  /// Waits for the device.
  void stop();

  /// Returns what goes on, in a few words: "refining, 40 % of every pixel"; "" where nothing does.
  std::string describe() const;

 private:
  LivePicture& choose(const Views& views, double now_s);

  // A window is open for long, and every choice of settings compiles a set of passes.
  static constexpr std::size_t kept_sets = 8;

  gpu::Device& device_;
  render::PassLibrary passes_;
  std::unique_ptr<Opening> opening_;
  std::unique_ptr<City> city_;
  std::unique_ptr<LivePicture> picture_;  // of city_
  std::unique_ptr<LivePicture> other_;    // of city_, as beside_ says
  Beside beside_ = Beside::nothing;
  std::unique_ptr<PictureJob> job_;  // of city_
  bool turn_of_other_ = false;
};

}  // namespace nightcity::viewer
