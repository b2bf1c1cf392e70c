// `nightbake new` tells archives for what they hold.
#include <gtest/gtest.h>
#include <zip.h>

#include <string_view>
#include <utility>

#include "support/temp_folder.h"
#include "tools/survey/survey.h"

namespace nightcity::survey {
namespace {

using test::TempFolder;

// A grid of 3 x 3 heights around the city, in its coordinates.
constexpr const char* small_grid =
    "ncols 3\nnrows 3\nxllcorner 390900\nyllcorner 5818900\ncellsize 100\n"
    "35 35 35\n35 35 35\n35 35 35\n";

TEST(Survey, AnArchiveOfHeightsIsOneWhateverLiesBeside) {
  const TempFolder folder;
  zip_t* zip = zip_open((folder / "dgm1.zip").c_str(), ZIP_CREATE, nullptr);
  const std::string_view index = "tile,lon,lat\na,13.4,52.5\n";
  for (const auto& [name, text] : {std::pair<const char*, std::string_view>{"dgm1.asc", small_grid},
                                   {"index.csv", index},
                                   {"meta.xml", "<metadata/>"}})
    zip_file_add(zip, name, zip_source_buffer(zip, text.data(), text.size(), 0), 0);
  ASSERT_EQ(zip_close(zip), 0);
  const auto files = survey_files({folder / "dgm1.zip"});
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].use, Use::elevation) << files[0].what;
  EXPECT_NE(files[0].what.find("one every 100 m"), std::string::npos) << files[0].what;
}

}  // namespace
}  // namespace nightcity::survey
