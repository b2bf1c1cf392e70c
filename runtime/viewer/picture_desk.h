// Saves the picture that is shown, while the window goes on.
#pragma once

#include "runtime/viewer/session.h"
#include "runtime/viewer/viewer.h"
#include "runtime/viewer/workbench.h"

namespace nightcity::viewer {

class PictureDesk {
 public:
  /// All must outlive the object.
  PictureDesk(const ViewOptions& options, Session& session, Workbench& workbench)
      : options_(options), session_(session), workbench_(workbench) {}

  /// Begins to save a view of the city, if there is one and none is being saved.
  void begin(const View& view, double now_s);
  void cancel(double now_s);
  /// Writes the picture that Workbench::Result::saved spoke of, and says where it is, or why not.
  void finish(double now_s);

 private:
  const ViewOptions& options_;
  Session& session_;
  Workbench& workbench_;
};

}  // namespace nightcity::viewer
