#include "tools/terrain/raster_transform.h"

#include <utility>

#include "formats/error.h"

namespace nightcity::terrain {

void find_raster_transform(GDALDataset& dataset, const std::string& file, double (&from_pixel)[6]) {
  if (dataset.GetGeoTransform(from_pixel) == CE_None) return;
  const int points = dataset.GetGCPCount();
  constexpr int least = 3, only_exact = FALSE;
  if (points >= least && GDALGCPsToGeoTransform(points, dataset.GetGCPs(), from_pixel, only_exact))
    return;
  if (points > 0)
    throw Error(file, "is placed by " + std::to_string(points) +
                          " ground control points on no common plane grid: straighten it "
                          "(gdalwarp -t_srs EPSG:<code> IN.tif OUT.tif)");
  for (const auto& [domain, option] :
       {std::pair{"RPC", "-rpc"}, std::pair{"GEOLOCATION", "-geoloc"}})
    if (dataset.GetMetadata(domain))
      throw Error(file, std::string("is placed by metadata alone (") + domain +
                            "): straighten it (gdalwarp " + option +
                            " -t_srs EPSG:<code> IN.tif OUT.tif)");
  throw Error(file,
              "names no place on earth: it has no geotransform (gdal_translate -a_ullr <west> "
              "<north> <east> <south> -a_srs EPSG:<code> IN.tif OUT.tif gives it one)");
}

}  // namespace nightcity::terrain
