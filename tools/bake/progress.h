// Progress of long work. The receiver decides how and how often to show it.
#pragma once

#include <functional>
#include <string>

namespace nightcity::bake {

struct Progress {
  std::string stage;      // in words: "reading 2 of 9: 3910_5820.gml"
  std::size_t count = 0;  // what the stage has done so far, in units
  std::string unit;       // "objects"
  std::size_t total = 0;  // of `count`, at the end; 0: unknown
};
using ProgressSink = std::function<void(const Progress&)>;

}  // namespace nightcity::bake
