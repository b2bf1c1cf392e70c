// Says what a fuzz target has found.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace nightcity::test {

/// Prints the fault and aborts; returns where there is none ("").
inline void abort_with(const std::string& fault) {
  if (fault.empty()) return;
  std::fprintf(stderr, "wrong: %s\n", fault.c_str());
  std::abort();
}

}  // namespace nightcity::test
