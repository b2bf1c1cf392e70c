// Zip archives that tests pack.
#pragma once

#include <gtest/gtest.h>
#include <zip.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nightcity::test {

/// Files of an archive: their names and bytes, in order.
using ZipFiles = std::vector<std::pair<std::string, std::string>>;

/// Writes an archive, in place of what is there.
inline void pack_zip(const std::filesystem::path& path, const ZipFiles& files) {
  zip_t* const archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [name, bytes] : files)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, bytes.data(), bytes.size(), 0),
                 0);
  ASSERT_EQ(zip_close(archive), 0);
}

}  // namespace nightcity::test
