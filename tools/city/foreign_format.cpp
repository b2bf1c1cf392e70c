#include "tools/city/foreign_format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "formats/packed_file.h"
#include "formats/to_lower.h"
#include "tools/city/foreign_names.h"
#include "tools/city/foreign_tables.h"
#include "tools/city/packing.h"

namespace nightcity::city {
namespace {

using namespace std::string_view_literals;
using namespace foreign;

// Returns the words of both: "is KML: export the model as CityGML first".
std::string join_words(const Foreign& file) {
  std::string text(file.what);
  if (!file.remedy.empty()) text.append(": ").append(file.remedy);
  return text;
}

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
  if (root == "model" && text.find("3dmanufacturing") != text.npos)
    return Foreign{"is a part of a 3MF file", as_obj, leads_to_model};
  if (root.starts_with("iestm33") || root == "luminaireopticaldata")  // and the edition's year
    return Foreign{"is photometry in TM-33", "it belongs in [[lamps.luminaires]]"};
  for (const Root& row : roots)
    if (row.name == root) return row.is;
  if (to_lower(text.substr(0, 64)).starts_with("<!doctype html")) return roots[0].is;
  return {};
}

std::optional<Foreign> find_packed(std::string_view bytes, std::string_view name) {
  if (find_packing(bytes) == Packing::zip)
    return Foreign{"is an archive in more archives than are looked into", "unpack the outer one"};
  if (bytes.starts_with("PK") || name.ends_with(".zip"))
    return Foreign{"is no zip archive, or the beginning of one that was cut off", "fetch it again"};
  if (bytes.starts_with("\x1F\x8B"))
    return Foreign{"is packed by gzip twice", "unpack it once (gunzip)"};
  const bool is_empty = std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == '\0'; });
  if (is_empty && is_named_as_archive(name)) return Foreign{"is a tar archive without files"};
  if (is_named_as_volume(name)) return Foreign{volume_words};
  return {};
}

// Returns the words for what a file is; without the remedy where this ends in a model and none is
// wanted.
std::string explain(std::string_view bytes, std::string_view name, bool wants_model) {
  const auto to_words = [wants_model](Foreign file) {
    if (!wants_model && file.leads == leads_to_model) file.remedy = {};
    return join_words(file);
  };
  for (const Mark& mark : binary_marks)
    if (bytes.starts_with(mark.bytes)) return to_words(mark.is);
  if (const std::string_view packed = describe_packed(bytes); !packed.empty())
    return std::string(packed);
  if (const auto packed = find_packed(bytes, name)) return to_words(*packed);
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
  const std::string what =
      "is XML of another kind: its root element is <" + std::string(written) + ">";
  return to_words({what,
                   "that of CityGML is <CityModel>; convert the file, or ask the portal for the "
                   "CityGML download",
                   leads_to_model});
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
  if (is_named_as_archive(name)) return "is named as an archive and is none: fetch it again";
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
