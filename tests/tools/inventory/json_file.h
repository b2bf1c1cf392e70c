// Texts in JSON, read as tables of lamps by tests.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/temp_folder.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::inventory {

inline Inventory read_json_file(const std::string& text, const std::string& crs = "EPSG:4326",
                                const std::string& name = "lamps.json") {
  const test::TempFolder folder;
  test::write_text(folder / name, text);
  InventoryFile file;
  file.file = folder / name;
  file.crs = crs;
  return read_inventory(file);
}

// Expects lamps at 13.4 E, 52.5 N and 13.41 E, 52.51 N.
inline void expect_two(const std::string& text, const std::string& crs = "EPSG:4326") {
  try {
    const Inventory read = read_json_file(text, crs);
    ASSERT_EQ(read.lamps.size(), 2u) << text;
    EXPECT_NEAR(read.lamps[0].lon_lat.x, 13.4, 1e-9) << text;
    EXPECT_NEAR(read.lamps[0].lon_lat.y, 52.5, 1e-9) << text;
    EXPECT_NEAR(read.lamps[1].lon_lat.x, 13.41, 1e-9) << text;
    EXPECT_NEAR(read.lamps[1].lon_lat.y, 52.51, 1e-9) << text;
    EXPECT_EQ(read.report.format, "JSON") << text;
    EXPECT_EQ(read.report.incomplete, "") << text;
  } catch (const Error& error) {
    ADD_FAILURE() << text << "\n" << error.what();
  }
}

inline std::string why_no_json(const std::string& text, const std::string& crs = "EPSG:4326") {
  return test::message_of([&] { read_json_file(text, crs); }, "was read");
}

inline constexpr const char* two_rows =
    R"([{"lat":52.5,"lon":13.4},{"lat":"52.51","lon":"13.41"}])";

}  // namespace nightcity::inventory
