// How far a long piece of work has come; whoever shows it decides how and how often.
#pragma once

#include <functional>
#include <string>

namespace nightcity {

/// `stage` in words ("reading 2 of 9: 3910_5820.gml"), `count` of what it has done so far ("objects").
struct Progress {
  std::string stage;
  std::size_t count = 0;
  std::string unit;
};
using ProgressSink = std::function<void(const Progress&)>;

}  // namespace nightcity
