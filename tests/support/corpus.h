// The files that a fuzzer starts from or has found, read in each test run.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>

namespace nightcity::test {

/// Expects that a folder has `least` files or more, and that `find_fault` has nothing to say ("") of
/// any of them: each is read as it should be, or refused with a reason.
template <class FindFault>
void expect_sound_files(const std::filesystem::path& folder, std::size_t least,
                        const FindFault& find_fault) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_EQ(find_fault(entry.path()), "") << entry.path();
    ++files;
  }
  EXPECT_GE(files, least);
}

}  // namespace nightcity::test
