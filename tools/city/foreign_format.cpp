#include "tools/city/foreign_format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "formats/packed_file.h"
#include "formats/to_lower.h"
#include "tools/city/foreign_names.h"
#include "tools/city/zip_archive.h"

namespace nightcity::city {
namespace {

using namespace std::string_view_literals;

// Says whether a remedy ends in a city model, and so helps only who wants one.
enum class Remedy : std::uint8_t { leads_to_data, leads_to_model };
constexpr Remedy leads_to_model = Remedy::leads_to_model;

struct Foreign {
  std::string_view what;      // "is KML"
  std::string_view remedy{};  // "export the model as CityGML first"; "": none is known
  Remedy leads = Remedy::leads_to_data;
};

// Returns the words of both: "is KML: export the model as CityGML first".
std::string join_words(const Foreign& foreign) {
  std::string text(foreign.what);
  if (!foreign.remedy.empty()) text.append(": ").append(foreign.remedy);
  return text;
}

constexpr std::string_view as_obj = "export it as Wavefront OBJ (Blender does)";
constexpr std::string_view table_or_model =
    "a table of lamps belongs in [[lamps.inventories]], a model has to be exported as CityGML "
    "first";
constexpr Foreign tile{"is a tile of 3D Tiles", "the CityGML that it was made of is needed",
                       leads_to_model};
constexpr Foreign inspire_data{"is INSPIRE data, not CityGML",
                               "ask the portal for the CityGML download, or convert it first",
                               leads_to_model};

struct Mark {
  std::string_view bytes;  // at the beginning
  Foreign is;
};

constexpr std::array binary_marks{
    Mark{"BZh"sv,
         {"is compressed by bzip2, which is read for OSM alone", "unpack it first (bunzip2)"}},
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
    Mark{"fgb\x03"sv, {"is FlatGeobuf", table_or_model, leads_to_model}},
    Mark{"PAR1"sv, {"is a Parquet table", "export it as GeoPackage or CSV (ogr2ogr)"}},
    Mark{"ARROW1"sv, {"is an Arrow or Feather table", "export it as GeoPackage or CSV (ogr2ogr)"}},
    Mark{"PMTiles"sv, {"is a set of tiles for maps (PMTiles)", "what it was made of is needed"}},
    Mark{"RDX3\n"sv, {"is data of R", "write the table as CSV (write.csv)"}},
    Mark{"Version 300"sv, {"is a MapInfo file", "export it as GeoPackage or CSV (ogr2ogr)"}},
    Mark{"INSERT INTO "sv, {"is a dump of a database (SQL)", "export the table as CSV"}},
    Mark{"CREATE TABLE "sv, {"is a dump of a database (SQL)", "export the table as CSV"}},
    Mark{"Kaydara FBX"sv, {"is FBX", as_obj, leads_to_model}},
    Mark{"; FBX"sv, {"is FBX", as_obj, leads_to_model}},
    Mark{"BLENDER"sv, {"is a Blender file", "export it as Wavefront OBJ", leads_to_model}},
    Mark{"ply\n"sv, {"is PLY", as_obj, leads_to_model}},
    Mark{"ply\r"sv, {"is PLY", as_obj, leads_to_model}},
    Mark{"solid "sv, {"is STL", as_obj, leads_to_model}},
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

constexpr std::array json_words{
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

constexpr std::array roots{
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
    Root{"gpx", {"is a track (GPX), not a map"}},
    Root{"landxml",
         {"is LandXML", "export it as CityGML, or its surface as a raster for [terrain] dem",
          leads_to_model}},
};

std::string_view skip_blanks(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

// A DXF in text begins with a comment (999) or a section, each number on a line of its own.
bool is_dxf(std::string_view text) {
  const std::string_view start = text.substr(0, 200);
  return (start.starts_with("0\n") || start.starts_with("0\r\n") || start.starts_with("999")) &&
         start.find("SECTION") != std::string_view::npos;
}

std::optional<Foreign> find_json(std::string_view text) {
  for (const Words& row : json_words) {
    const auto holds = [text](std::string_view word) { return text.find(word) != text.npos; };
    if (std::all_of(row.words.begin(), row.words.end(), holds)) return row.is;
  }
  if (!text.starts_with('{')) return Foreign{"is a list in JSON", table_or_model, leads_to_model};
  return Foreign{"is JSON of another kind", "neither CityJSON nor glTF"};
}

// Returns what a document in XML is by its root element, whose name is `root` in lower case.
std::optional<Foreign> find_xml(std::string_view text, std::string_view root) {
  if (root == "featurecollection") {
    if (text.find("inspire") != text.npos) return inspire_data;
    return Foreign{"is GML, but not CityGML",
                   "its features are none of a city model; ask the portal for the CityGML "
                   "download, or export a table of lamps as GeoJSON",
                   leads_to_model};
  }
  if (root == "dataset" && text.find("fgd.gsi.go.jp") != text.npos)
    return Foreign{"is GML of the Geospatial Information Authority of Japan",
                   "an elevation model belongs in [terrain] dem under its own name "
                   "(FG-GML-...-DEM...xml); otherwise convert it to GeoTIFF first"};
  if (root.starts_with("iestm33") || root == "luminaireopticaldata")  // and the edition's year
    return Foreign{"is photometry in TM-33", "it belongs in [[lamps.luminaires]]"};
  for (const Root& row : roots)
    if (row.name == root) return row.is;
  if (to_lower(text.substr(0, 64)).starts_with("<!doctype html")) return roots[0].is;
  return {};
}

std::optional<Foreign> find_packed(std::string_view bytes, std::string_view name) {
  if (bytes.starts_with(zip_mark) && name.ends_with(".gz"))
    return Foreign{"is a zip archive that was packed by gzip as well", "unpack it once (gunzip)"};
  if (bytes.starts_with("PK") || name.ends_with(".zip"))
    return Foreign{"is no zip archive, or the beginning of one that was cut off", "fetch it again"};
  if (bytes.starts_with("\x1F\x8B"))
    return Foreign{"is packed by gzip twice", "unpack it once (gunzip)"};
  return {};
}

// Returns the words for what a file is; without the remedy where this ends in a model and none is
// wanted.
std::string explain(std::string_view bytes, std::string_view name, bool wants_model) {
  const auto to_words = [wants_model](Foreign foreign) {
    if (!wants_model && foreign.leads == leads_to_model) foreign.remedy = {};
    return join_words(foreign);
  };
  if (is_packed_tar(name))
    return "is a tar archive: unpack it first (tar -xf) and name the files in it";
  for (const Mark& mark : binary_marks)
    if (bytes.starts_with(mark.bytes)) return to_words(mark.is);
  if (const std::string_view packed = describe_packed(bytes); !packed.empty())
    return std::string(packed);
  if (const auto packed = find_packed(bytes, name)) return to_words(*packed);
  if (name.ends_with(".gz") || name.ends_with(".tgz")) return {};
  if (name.ends_with("3dscenelayer.json"))
    return to_words({"is a scene layer of I3S", tile.remedy, leads_to_model});
  const std::string_view text = skip_blanks(bytes);
  if (text.starts_with('{') || text.starts_with('[')) {
    const auto json = find_json(text);
    return json ? to_words(*json) : "";
  }
  if (is_dxf(text))
    return to_words(
        {"is a drawing (DXF)", "export it as CityGML or Wavefront OBJ", leads_to_model});
  if (!text.starts_with('<')) return {};
  const std::string_view written = find_root_name(text);
  if (const auto xml = find_xml(text, to_lower(written))) return to_words(*xml);
  if (written.empty()) return {};
  if (text.find("citygml") != text.npos)
    return "is one <" + std::string(written) +
           "> without the <CityModel> round it: ask the server for all features (GetFeature), or "
           "write <CityModel><cityObjectMember> before it";
  return "is XML of another kind: its root element is <" + std::string(written) + ">";
}

}  // namespace

std::string_view find_root_name(std::string_view start) {
  std::size_t at = start.find('<');
  while (at != std::string_view::npos && at + 1 < start.size()) {
    if (start[at + 1] != '?' && start[at + 1] != '!') {
      std::string_view name = start.substr(at + 1);
      const std::size_t end = name.find_first_of(" \t\r\n/>");
      if (end == std::string_view::npos) return {};
      name = name.substr(0, end);
      const std::size_t colon = name.rfind(':');
      return colon == std::string_view::npos ? name : name.substr(colon + 1);
    }
    const std::string_view end = start.substr(at).starts_with("<!--") ? "-->" : ">";
    at = start.find(end, at);
    if (at != std::string_view::npos) at = start.find('<', at);
  }
  return {};
}

std::string explain_foreign(std::string_view bytes, std::string_view name) {
  if (name.ends_with(".toml")) return "is named as a recipe: `nightbake run` reads it";
  if (std::string found = explain(bytes, name, true); !found.empty()) return found;
  return std::string(explain_by_name(name));
}

std::string name_foreign(std::string_view bytes, std::string_view name) {
  const std::string root = to_lower(find_root_name(bytes));
  if (root == "citymodel" || bytes.find("\"CityObjects\"") != bytes.npos)
    return "is a city model: it belongs in [city] files";
  if (root == "osm") return "is a map of OpenStreetMap: it belongs in [osm] files";
  return explain(bytes, name, false);
}

}  // namespace nightcity::city
