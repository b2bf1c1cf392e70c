#include "tools/inputs/foreign_format.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "formats/packed_file.h"
#include "formats/to_lower.h"

namespace nightcity::inputs {
namespace {

using namespace std::string_view_literals;

struct Mark {
  std::string_view bytes;  // at the beginning
  const char* explanation;
};

constexpr std::array binary_marks{
    Mark{"BZh"sv, "is compressed by bzip2, which is read for OSM alone: unpack it first (bunzip2)"},
    Mark{"PK\x05\x06"sv, "is a zip archive without files"},
    Mark{"PK\x07\x08"sv, "is a part of a zip archive in several volumes: join and unpack it first"},
    Mark{"%PDF"sv, "is a PDF document, not data"},
    Mark{"\x89PNG"sv, "is a picture (PNG)"},
    Mark{"\xFF\xD8\xFF"sv, "is a picture (JPEG)"},
    Mark{"II*\0"sv, "is a TIFF raster: heights belong in [terrain] dem"},
    Mark{"MM\0*"sv, "is a TIFF raster: heights belong in [terrain] dem"},
    Mark{"SQLite format 3\0"sv,
         "is a GeoPackage or another SQLite database: a table of lamps belongs in "
         "[[lamps.inventories]], a model has to be exported as CityGML first"},
    Mark{"\0\0\x27\x0A"sv,
         "is a Shapefile: a table of lamps belongs in [[lamps.inventories]], a model has to be "
         "exported as CityGML first"},
    Mark{"LASF"sv, "is a point cloud (LAS, LAZ): surfaces are needed"},
    Mark{"ISO-10303-21"sv, "is IFC or another STEP file: export it as CityGML first"},
    Mark{"b3dm"sv, "is a tile of 3D Tiles: the CityGML that it was made of is needed"},
    Mark{"version https://git-lfs"sv,
         "is a pointer of Git LFS and not the file itself: fetch it (git lfs pull)"},
};

// Text formats by words in their beginning: all of a row's words must be there. The first row that
// fits is taken.
struct Words {
  std::array<std::string_view, 2> words;
  const char* explanation;
};

constexpr std::array json_words{
    Words{{"\"osm3s\"", ""}, "is an answer of Overpass in JSON: ask for XML instead ([out:xml])"},
    Words{{"\"elements\"", "\"generator\""},
          "is an answer of Overpass in JSON: ask for XML instead ([out:xml])"},
    Words{{"\"FeatureCollection\"", ""},
          "is GeoJSON: a table of lamps belongs in [[lamps.inventories]], a model has to be "
          "exported as CityGML first"},
    Words{{"\"geometricError\"", ""},
          "is a tileset of 3D Tiles: the CityGML that it was made of is needed"},
    Words{{"\"error\"", ""}, "is a server's answer that reports an error: look into it"},
};

// Root elements, without prefix and in lower case.
struct Root {
  std::string_view name;
  const char* explanation;
};

constexpr std::array roots{
    Root{"html",
         "is a web page, not data: the download gave a page of the portal (a login or an "
         "error); look into it and fetch the file itself"},
    Root{"osmchange",
         "is an OSM change file (.osc), which holds changes and no map: apply it to a "
         "map first (osmium apply-changes)"},
    Root{"spatialdataset",
         "is INSPIRE data, not CityGML: ask the portal for the CityGML download, or "
         "convert it first"},
    Root{"exceptionreport",
         "is a server's answer that reports an error, not data: look into it and "
         "repair the request"},
    Root{"serviceexceptionreport",
         "is a server's answer that reports an error, not data: look into "
         "it and repair the request"},
    Root{"wfs_capabilities",
         "is a description of a WFS server (GetCapabilities), not data: ask it "
         "for features (GetFeature)"},
    Root{"dictionary", "is a code list, which belongs to a city model and is none"},
    Root{"metadata", "is metadata, which describes a city model and is none"},
    Root{"md_metadata", "is metadata, which describes a city model and is none"},
    Root{"schema", "is an XML schema, not data"},
    Root{"feed", "is a feed (Atom), which lists downloads: fetch one of the files that it names"},
    Root{"kml", "is KML: export the model as CityGML first"},
    Root{"collada", "is COLLADA: export the model as CityGML first"},
    Root{"gpx", "is a track (GPX), not a map"},
    Root{"landxml",
         "is LandXML: export it as CityGML, or its surface as a raster for [terrain] dem"},
};

std::string_view skip_blanks(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

std::string explain_json(std::string_view text) {
  for (const Words& row : json_words) {
    const auto holds = [text](std::string_view word) { return text.find(word) != text.npos; };
    if (std::all_of(row.words.begin(), row.words.end(), holds)) return row.explanation;
  }
  return text.starts_with('{') ? "is JSON of another kind: neither CityJSON nor glTF" : "";
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
  for (const Mark& mark : binary_marks)
    if (bytes.starts_with(mark.bytes)) return mark.explanation;
  if (const std::string_view packed = describe_packed(bytes); !packed.empty())
    return std::string(packed);
  if (bytes.starts_with("PK") || name.ends_with(".zip"))
    return "is no zip archive, or the beginning of one that was cut off: fetch it again";
  if (name.ends_with(".gz") || name.ends_with(".tgz")) return {};
  const std::string_view text = skip_blanks(bytes);
  if (text.starts_with('{') || text.starts_with('[')) return explain_json(text);
  if (!text.starts_with('<')) return {};
  const std::string_view written = find_root_name(text);
  const std::string root = to_lower(written);
  for (const Root& row : roots)
    if (row.name == root) return row.explanation;
  if (to_lower(text.substr(0, 64)).starts_with("<!doctype html")) return roots[0].explanation;
  if (root.empty()) return {};
  return "is XML of another kind: its root element is <" + std::string(written) + ">";
}

}  // namespace nightcity::inputs
