// The files of other kinds that are known: by their first bytes, by words in JSON, and by the root
// elements of XML.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace nightcity::city::foreign {

using namespace std::string_view_literals;

// Says whether a remedy ends in a city model, and so helps only who wants one.
enum class Remedy : std::uint8_t { leads_to_data, leads_to_model };
inline constexpr Remedy leads_to_model = Remedy::leads_to_model;

struct Foreign {
  std::string_view what;      // "is KML"
  std::string_view remedy{};  // "export the model as CityGML first"; "": none is known
  Remedy leads = Remedy::leads_to_data;
};

inline constexpr std::string_view as_obj = "export it as Wavefront OBJ (Blender does)";
inline constexpr std::string_view table_or_model =
    "a table of lamps belongs in [[lamps.inventories]], a model has to be exported as CityGML "
    "first";
inline constexpr Foreign tile{"is a tile of 3D Tiles", "the CityGML that it was made of is needed",
                              leads_to_model};
inline constexpr Foreign inspire_data{
    "is INSPIRE data, not CityGML", "ask the portal for the CityGML download, or convert it first",
    leads_to_model};

inline constexpr Foreign database_dump{
    "is a dump of a PostgreSQL database",
    "restore it, and export CityGML from it (3DCityDB's Importer/Exporter or citydb-tool)",
    leads_to_model};
inline constexpr Foreign sql_dump{
    "is a dump of a database (SQL)",
    "export the table as CSV; a city model has to be exported as CityGML"};
inline constexpr Foreign cadastre{
    "is a cadastre in NAS, not CityGML",
    "its outlines have no heights; ask the portal for the CityGML download", leads_to_model};

struct Mark {
  std::string_view bytes;  // at the beginning
  Foreign is;
};

inline constexpr std::array binary_marks{
    Mark{"BZh"sv, {"is packed by bzip2 once more", "unpack it once (bunzip2)"}},
    Mark{"MZ"sv,
         {"is a program of Windows", "if it is an archive that unpacks itself, unpack it first"}},
    Mark{"PK\x05\x06"sv, {"is a zip archive without files"}},
    Mark{"PK\x07\x08"sv,
         {"is a part of a zip archive in several volumes", "join and unpack it first"}},
    Mark{"%PDF"sv, {"is a PDF document, not data"}},
    Mark{"\x89PNG"sv, {"is a picture (PNG)"}},
    Mark{"\xFF\xD8\xFF"sv, {"is a picture (JPEG)"}},
    Mark{"II*\0"sv, {"is a TIFF raster", "heights belong in [terrain] dem"}},
    Mark{"MM\0*"sv, {"is a TIFF raster", "heights belong in [terrain] dem"}},
    Mark{"SQLite format 3\0"sv,
         {"is a GeoPackage or another SQLite database", table_or_model, leads_to_model}},
    Mark{"\0\0\x27\x0A"sv, {"is a Shapefile", table_or_model, leads_to_model}},
    Mark{"LASF"sv, {"is a point cloud (LAS, LAZ)", "surfaces are needed", leads_to_model}},
    Mark{"ISO-10303-21"sv,
         {"is IFC or another STEP file", "export it as CityGML first", leads_to_model}},
    Mark{"b3dm"sv, tile},
    Mark{"i3dm"sv, tile},
    Mark{"cmpt"sv, tile},
    Mark{"pnts"sv, {"is a point cloud (3D Tiles)", "surfaces are needed", leads_to_model}},
    Mark{"ASTM-E57"sv, {"is a point cloud (E57)", "surfaces are needed", leads_to_model}},
    Mark{"fcb\x01"sv, {"is FlatCityBuf", "turn it into CityJSONSeq (fcb deser)", leads_to_model}},
    Mark{"fgb\x03"sv, {"is FlatGeobuf", table_or_model, leads_to_model}},
    Mark{"PAR1"sv, {"is a Parquet table", "export it as GeoPackage or CSV (ogr2ogr)"}},
    Mark{"ARROW1"sv, {"is an Arrow or Feather table", "export it as GeoPackage or CSV (ogr2ogr)"}},
    Mark{"PMTiles"sv, {"is a set of tiles for maps (PMTiles)", "what it was made of is needed"}},
    Mark{"RDX3\n"sv, {"is data of R", "write the table as CSV (write.csv)"}},
    Mark{"Version 300"sv, {"is a MapInfo file", "export it as GeoPackage or CSV (ogr2ogr)"}},
    Mark{"INSERT INTO "sv, sql_dump},
    Mark{"CREATE TABLE "sv, sql_dump},
    Mark{"Kaydara FBX"sv, {"is FBX", as_obj, leads_to_model}},
    Mark{"; FBX"sv, {"is FBX", as_obj, leads_to_model}},
    Mark{"BLENDER"sv, {"is a Blender file", "export it as Wavefront OBJ", leads_to_model}},
    Mark{"ply\n"sv, {"is PLY", as_obj, leads_to_model}},
    Mark{"ply\r"sv, {"is PLY", as_obj, leads_to_model}},
    Mark{"solid "sv, {"is STL", as_obj, leads_to_model}},
    Mark{"OFF\n"sv, {"is OFF", as_obj, leads_to_model}},
    Mark{"3D Geometry File Format"sv,
         {"is a Rhino file", "export it as Wavefront OBJ", leads_to_model}},
    Mark{"PGDMP"sv, database_dump},
    Mark{"--\n-- PostgreSQL database dump"sv, database_dump},
    Mark{"#VRML"sv, {"is VRML", as_obj, leads_to_model}},
    Mark{"PXR-USDC"sv, {"is USD", as_obj, leads_to_model}},
    Mark{"#usda"sv, {"is USD", as_obj, leads_to_model}},
    Mark{"AC10"sv, {"is a drawing (DWG)", "export it as CityGML or Wavefront OBJ", leads_to_model}},
    Mark{"GIF8"sv, {"is a picture (GIF)"}},
    Mark{"RIFF"sv, {"is a picture, sound or film (RIFF)"}},
    Mark{"\xD0\xCF\x11\xE0"sv,
         {"is a document of Microsoft's older formats (Excel, Revit, ...)",
          "save a table as CSV, export a model as CityGML or IFC", leads_to_model}},
    Mark{"\x1F\x9D"sv, {"is packed by compress", "unpack it first (uncompress)"}},
    Mark{"MSCF"sv, {"is a cabinet archive", "unpack it first"}},
    Mark{"version https://git-lfs"sv,
         {"is a pointer of Git LFS and not the file itself", "fetch it (git lfs pull)"}},
};

// Text formats by words in their beginning: all of a row's words must be there. The first row that
// fits is taken.
struct Words {
  std::array<std::string_view, 2> words;
  Foreign is;
};

inline constexpr std::array json_words{
    Words{{"\"osm3s\"", ""}, {"is an answer of Overpass in JSON", "a map belongs in [osm] files"}},
    Words{{"\"elements\"", "\"generator\""},
          {"is OpenStreetMap's data in JSON", "a map belongs in [osm] files"}},
    Words{{"\"CityJSONExtension\"", ""},
          {"is an extension of CityJSON, which describes additions to city models and is none"}},
    Words{{"\"Topology\"", "\"arcs\""},
          {"is TopoJSON",
           "a table of lamps belongs in [[lamps.inventories]] as GeoJSON, a model has to be "
           "exported as CityGML first",
           leads_to_model}},
    Words{{"\"Feature\"", "\"geometry\""}, {"is GeoJSON", table_or_model, leads_to_model}},
    Words{{"\"esriGeometry", ""}, {"is JSON of Esri", table_or_model, leads_to_model}},
    Words{{"\"FeatureCollection\"", ""}, {"is GeoJSON", table_or_model, leads_to_model}},
    Words{
        {"\"geometricError\"", ""},
        {"is a tileset of 3D Tiles", "the CityGML that it was made of is needed", leads_to_model}},
    Words{{"\"error\"", ""}, {"is a server's answer that reports an error", "look into it"}},
};

// Root elements, without prefix and in lower case.
struct Root {
  std::string_view name;
  Foreign is;
};

inline constexpr std::array roots{
    Root{"html",
         {"is a web page, not data",
          "the download gave a page of the portal (a login or an error); look into it and fetch "
          "the file itself"}},
    Root{"osmchange",
         {"is an OSM change file (.osc), which holds changes and no map",
          "apply it to a map first (osmium apply-changes)"}},
    Root{"spatialdataset", inspire_data},
    Root{"exceptionreport",
         {"is a server's answer that reports an error, not data",
          "look into it and repair the request"}},
    Root{"serviceexceptionreport",
         {"is a server's answer that reports an error, not data",
          "look into it and repair the request"}},
    Root{"wfs_capabilities",
         {"is a description of a WFS server (GetCapabilities), not data",
          "ask it for features (GetFeature)"}},
    Root{"dictionary", {"is a code list, which belongs to a city model and is none"}},
    Root{"metadata", {"is metadata, which describes a city model and is none"}},
    Root{"md_metadata", {"is metadata, which describes a city model and is none"}},
    Root{"schema", {"is an XML schema, not data"}},
    Root{"feed",
         {"is a feed (Atom), which lists downloads", "fetch one of the files that it names"}},
    Root{"types", {"is a spreadsheet or another document of Office", "save a table as CSV"}},
    Root{"error", {"is a server's answer that reports an error", "look into it"}},
    Root{"envelope", {"is a server's answer (SOAP), not data", "look into it"}},
    Root{"ifcxml", {"is IFC (ifcXML)", "export it as CityGML first", leads_to_model}},
    Root{"indoorfeatures",
         {"is IndoorGML, which describes rooms", "the CityGML of the buildings is needed",
          leads_to_model}},
    Root{"kml", {"is KML", "export the model as CityGML first", leads_to_model}},
    Root{"collada", {"is COLLADA", "export the model as CityGML first", leads_to_model}},
    Root{"x3d", {"is X3D", as_obj, leads_to_model}},
    Root{"gbxml",
         {"is gbXML, which describes a building's energy",
          "export the building as CityGML or Wavefront OBJ", leads_to_model}},
    Root{"ax_bestandsdatenauszug", cadastre},
    Root{"ax_nutzerbezogenebestandsdatenaktualisierung_nba", cadastre},
    Root{"xplanauszug",
         {"is a plan of land use (XPlanGML), not CityGML",
          "ask the portal for the CityGML of the buildings", leads_to_model}},
    Root{"vymennyformat",
         {"is a register of parcels and addresses (VFR), not CityGML",
          "its outlines have no heights; ask the portal for a city model", leads_to_model}},
    Root{
        "bagstand",
        {"is the Dutch register of buildings (BAG), not CityGML",
         "its outlines have no heights; 3DBAG has the same buildings as CityJSON", leads_to_model}},
    Root{"gpx", {"is a track (GPX), not a map"}},
    Root{"landxml",
         {"is LandXML", "export it as CityGML, or its surface as a raster for [terrain] dem",
          leads_to_model}},
};

}  // namespace nightcity::city::foreign
