// Edits the light that was clicked, from keys and from the sliders below its values.
#pragma once

#include <functional>

#include "runtime/viewer/light_editor.h"
#include "runtime/viewer/session.h"
#include "runtime/viewer/workbench.h"

namespace nightcity::viewer {

class LightDesk {
 public:
  /// Both must outlive the object.
  LightDesk(Session& session, Workbench& workbench) : session_(session), workbench_(workbench) {}

  /// Takes the edits of the city that is shown now.
  void open() { editor_ = workbench_.city().edits; }
  /// Changes the light that was clicked, or says that none was.
  void edit(const std::function<void(LightEdit&)>& change, double now_s);
  /// Draws the sliders of the light that was clicked, if one was.
  void draw(double now_s);
  void save(double now_s);
  const LightEdits& edits() const { return editor_.edits(); }

 private:
  Session& session_;
  Workbench& workbench_;
  LightEditor editor_;
};

}  // namespace nightcity::viewer
