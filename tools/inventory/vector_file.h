// A vector file of another program, opened by one of the drivers that are allowed.
#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <filesystem>

#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

/// Names of columns with coordinates that open portals use, as GDAL's CSV driver takes them.
inline constexpr const char* x_names =
    "lon,long,lng,longitude,x,x_coord,xcoord,coord_x,point_x,easting,laengengrad,längengrad,"
    "geo_laenge,rechtswert,ostwert,longitud,longitudine,lengtegraad,x_wgs84,lon_wgs84,utm_x,utm_e,"
    "geo_lon,geo_lng,geo_long,dlugosc,długość,dlugosc_geo,zem_delka,zeměpisná délka,delka,x_4326,"
    "lon (*,long (*,longitude (*,x (*,easting (*,lon [*,longitude [*,x [*,easting [*";
inline constexpr const char* y_names =
    "lat,latitude,y,y_coord,ycoord,coord_y,point_y,northing,breitengrad,geo_breite,hochwert,"
    "nordwert,latitud,latitudine,breedtegraad,y_wgs84,lat_wgs84,utm_y,utm_n,"
    "geo_lat,szerokosc,szerokość,szerokosc_geo,zem_sirka,zeměpisná šířka,sirka,y_4326,"
    "lat (*,latitude (*,y (*,northing (*,lat [*,latitude [*,y [*,northing [*";
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
