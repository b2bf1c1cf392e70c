// A vector file of another program, opened by one of the drivers that are allowed.
#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <filesystem>

#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

/// Columns with whole geometries, as text.
inline constexpr const char* geometry_names = "wkt,the_geom,geom,geometry,wkt_geom,geo_shape";

/// Opens the file. GDAL has drivers that are programs in all but name (VRT, WFS, databases), so
/// only those whose file is the table itself may open it. Throws Error: missing, no regular file,
/// packed, of no such format, broken.
GDALDatasetUniquePtr open_vector_file(const InventoryFile& inventory);

/// Returns the layer that the inventory names or the only one. Throws Error, with the names of the
/// layers there are.
OGRLayer& find_layer(GDALDataset& dataset, const InventoryFile& inventory);

/// Returns the column of a layer without geometries that holds latitude and longitude in one text
/// ("48.85, 2.35"), as portals name it; -1 where there is none.
int find_point_column(OGRLayer& layer);

/// Returns the short name of the driver, for reports: "GeoJSON".
const char* driver_name(GDALDataset& dataset);

}  // namespace nightcity::inventory
