// A vector file of another program, opened by one of the drivers that are allowed.
#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <string>

#include "tools/inventory/inventory.h"
#include "tools/inventory/memory_folder.h"

namespace nightcity::inventory {

/// Columns with whole geometries, as text.
inline constexpr const char* geometry_names = "wkt,the_geom,geom,geometry,wkt_geom,geo_shape";

struct VectorFile {
  MemoryFolder memory;  // with the dataset's files where they are none of the disk
  GDALDatasetUniquePtr dataset;
  std::string path;        // as GDAL takes it
  std::string stem;        // of the table's name, which in an archive is another than the file's
  std::string format;      // for reports: "GeoJSON"
  std::string crs;         // that its form says and GDAL does not know; "": none
  std::string encoding;    // that no mark names and its headings tell; "": UTF-8 or Windows-1252
  std::size_t titles = 0;  // lines of a CSV above its headings
  std::string incomplete;  // what the server left out; "": its rows say nothing of that
};

/// Opens the file. GDAL has drivers that are programs in all but name (VRT, WFS, databases), so
/// only those whose file is the table itself may open it. One in an archive or a stream is unpacked
/// into memory, and there go texts that GDAL misreads (UTF-16, a CSV below titles, rows in JSON
/// that is no GeoJSON), in a form that it reads. Throws Error: missing, no regular file, of no such
/// format, broken.
VectorFile open_vector_file(const InventoryFile& inventory);

/// Returns the layer that the inventory names or the only one. Throws Error, with the names of the
/// layers there are.
OGRLayer& find_layer(GDALDataset& dataset, const InventoryFile& inventory);

/// Returns the column of a layer without geometries that holds latitude and longitude in one text
/// ("48.85, 2.35"), as portals name it; -1 where there is none.
int find_point_column(OGRLayer& layer);

}  // namespace nightcity::inventory
