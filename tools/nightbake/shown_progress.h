// The progress of a bake, shown on stderr.
#pragma once

#include "formats/program/progress_display.h"
#include "tools/bake/progress.h"

namespace nightcity::nightbake {

class ShownProgress {
 public:
  /// Returns what functions report their progress to. It refers to this object.
  bake::ProgressSink sink() {
    return [this](const bake::Progress& progress) {
      display_.show({progress.stage, progress.count, progress.total, progress.unit});
    };
  }

 private:
  program::ProgressDisplay display_;
};

}  // namespace nightcity::nightbake
