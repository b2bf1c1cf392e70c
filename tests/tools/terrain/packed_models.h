// Archives of elevation models, as tests pack and ask them.
#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/pack_archive.h"
#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tools/terrain/open_models.h"
#include "tools/terrain/raster_names.h"

namespace nightcity::terrain {

using Entries = test::ZipFiles;
using test::pack_zip;

inline void pack_gzip(const std::filesystem::path& path, const std::string& bytes) {
  const gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())),
            static_cast<int>(bytes.size()));
  gzclose(file);
}

inline std::string to_gzip(const std::string& bytes) {
  const test::TempFolder folder;
  pack_gzip(folder / "a.gz", bytes);
  return test::read_text(folder / "a.gz");
}

// A grid of 3 x 3 heights in a plan of metres, whose middle is 391010, 5819010.
inline std::string make_ascii_grid(double height) {
  std::string text =
      "ncols 3\nnrows 3\nxllcorner 390995\nyllcorner 5818995\ncellsize 10\nNODATA_value -9999\n";
  for (int i = 0; i < 9; ++i) text += std::to_string(height) + (i % 3 == 2 ? "\n" : " ");
  return text;
}

inline std::string make_table(double height) {
  std::string rows;
  for (int y = 2; y >= 0; --y)
    for (int x = 0; x < 3; ++x)
      rows += std::to_string(391000 + 10 * x) + " " + std::to_string(5819000 + 10 * y) + " " +
              std::to_string(height) + "\n";
  return rows;
}

// A GeoTIFF without a place of its own.
inline std::string make_tiff(float height, GDALDataType type = GDT_Float32) {
  const test::TempFolder folder;
  GDALAllRegister();
  {
    GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        (folder / "a.tif").c_str(), 3, 3, 1, type, nullptr));
    std::vector<float> values(9, height);
    EXPECT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 3, 3, values.data(), 3, 3,
                                              GDT_Float32, 0, 0),
              CE_None);
  }
  return test::read_text(folder / "a.tif");
}

inline constexpr const char* world_file = "10\n0\n0\n-10\n391000\n5819020\n";
inline constexpr glm::dvec2 in_plan(391010, 5819010), in_degrees(13.39402, 52.51030);

inline std::string make_prj() {
  OGRSpatialReference crs;
  crs.importFromEPSG(25833);
  crs.morphToESRI();
  char* text = nullptr;
  crs.exportToWkt(&text);
  const std::string made = text;
  CPLFree(text);
  return made;
}

inline double height_of(const ElevationModel& model) {
  double height = 0;
  const glm::dvec2 place = model.has_crs() ? in_degrees : in_plan;
  model.sample(std::span(&place, 1), std::span(&height, 1));
  return height;
}

inline std::vector<double> heights_of(const std::filesystem::path& path,
                                      const ElevationOptions& options = {}) {
  std::vector<double> heights;
  for (const ElevationModel& model : open_elevation_models(list_raster_files(path), options))
    heights.push_back(height_of(model));
  return heights;
}

inline std::string why_not(const std::filesystem::path& path,
                           const ElevationOptions& options = {}) {
  return test::message_of([&] { heights_of(path, options); }, "was read");
}

}  // namespace nightcity::terrain
