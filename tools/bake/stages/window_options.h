// Options of the stage that makes lit windows.
#pragma once

#include <cstdint>

namespace nightcity::bake {

struct WindowStageOptions {
  bool lit = true;         // false: there are none
  std::uint64_t seed = 1;  // decides who is at home
};

}  // namespace nightcity::bake
