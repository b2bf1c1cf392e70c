// The files that a fuzzer starts from or has found, read in each test run.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/error.h"
#include "support/temp_folder.h"

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

struct FilesRead {
  std::size_t sound = 0, refused = 0;
};

/// Passes each file of a folder to `read`, and expects that this returns or throws an Error with a
/// reason, and that there are `least` files or more.
template <class Read>
FilesRead read_each_file(const std::filesystem::path& folder, std::size_t least, const Read& read) {
  FilesRead files;
  expect_sound_files(folder, least, [&](const std::filesystem::path& file) -> std::string {
    try {
      read(file);
      ++files.sound;
    } catch (const Error& error) {
      ++files.refused;
      if (std::string(error.what()).empty()) return "is refused without a reason";
    }
    return "";
  });
  return files;
}

/// Passes the bytes of each file of a folder, of which there are `least` or more, to what a fuzzer
/// calls.
inline void feed_each_file(const std::filesystem::path& folder, std::size_t least,
                           int (*fuzz)(const std::uint8_t* data, std::size_t size)) {
  expect_sound_files(folder, least, [&](const std::filesystem::path& file) -> std::string {
    SCOPED_TRACE(file);
    const std::string text = read_text(file);
    fuzz(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    return "";
  });
}

}  // namespace nightcity::test
