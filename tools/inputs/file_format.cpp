#include "tools/inputs/file_format.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/byte_source.h"
#include "tools/city/foreign_format.h"
#include "tools/city/packing.h"
#include "tools/citygml/citygml_cuts.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/read_citygml.h"
#include "tools/cityjson/read_cityjson.h"
#include "tools/inputs/city_files.h"
#include "tools/lights/luminaire.h"
#include "tools/map_buildings/read_map_buildings.h"
#include "tools/obj/read_obj.h"
#include "tools/osm/map_file.h"
#include "tools/osm/osm_marks.h"
#include "tools/osm/read_osm.h"

namespace nightcity::inputs {
namespace {

constexpr std::size_t start_bytes = 65536;  // XML may begin with long comments

bool holds(const FileStart& start, std::string_view text) {
  return start.bytes.find(text) != std::string_view::npos;
}

// A FeatureCollection holds features of any schema, and that of CityGML is named before the first.
bool is_citygml(const FileStart& start) {
  if (!citygml::begins_as_citygml(start.bytes)) return false;
  const bool has_features = holds(start, "ember>") || holds(start, "embers>");
  return city::find_root_name(start.bytes) != "FeatureCollection" || !has_features ||
         holds(start, "citygml");
}

bool is_cityjson(const FileStart& start) {
  return cityjson::begins_as_cityjson(start.bytes);
}

bool is_osm(const FileStart& start) {
  return osm::begins_as_osm(start.bytes);
}

bool is_gltf(const FileStart& start) {
  if (start.bytes.starts_with("glTF")) return true;
  const std::size_t first = start.bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const bool json = first != std::string_view::npos && start.bytes[first] == '{';
  // A large glTF may name its asset last.
  return json && !holds(start, "\"geometricError\"") &&
         (holds(start, "\"asset\"") || start.name.ends_with(".gltf"));
}

bool is_light_file(const FileStart& start) {
  return start.bytes.starts_with("NCLIGHTS");
}

// Files before LM-63-1991 have no mark but the TILT line.
bool is_ies(const FileStart& start) {
  return lights::begins_as_ies(start.bytes) || start.name.ends_with(".ies");
}

bool is_eulumdat(const FileStart& start) {
  return lights::begins_as_eulumdat(start.bytes) || start.name.ends_with(".ldt");
}

bool is_tm33(const FileStart& start) {
  return lights::begins_as_tm33(start.bytes);
}

// The document of the container that says what else lies in it.
bool is_gldf(const FileStart& start) {
  return start.packed && start.name == "product.xml" &&
         city::find_root_name(start.bytes) == "Root" && holds(start, "GeneralDefinitions");
}

constexpr city::FileReader citygml_reader{citygml::read_citygml_head, citygml::read_citygml_staged,
                                          citygml::find_citygml_cuts};

constexpr city::FileReader cityjson_reader{cityjson::read_cityjson_head,
                                           cityjson::read_cityjson_staged};

bool is_obj(const FileStart& start) {
  return obj::begins_as_obj(start.bytes);
}

constexpr city::FileReader obj_reader{obj::read_obj_head, obj::read_obj_staged};

// The buildings of a map, where it is named as a city.
constexpr city::FileReader map_reader{map_buildings::read_map_head,
                                      map_buildings::read_map_buildings};

constexpr std::array formats{
    FileFormat{"CityJSON", FileKind::city, is_cityjson, true, cityjson::cityjson_endings,
               &cityjson_reader},
    FileFormat{"glTF", FileKind::scene, is_gltf},
    FileFormat{"light file", FileKind::lights, is_light_file},
    FileFormat{"OSM", FileKind::osm, is_osm, true, {}, &map_reader},
    FileFormat{"CityGML", FileKind::city, is_citygml, true, citygml::citygml_endings,
               &citygml_reader},
    FileFormat{"IES", FileKind::luminaire, is_ies, true},
    FileFormat{"EULUMDAT", FileKind::luminaire, is_eulumdat, true},
    FileFormat{"TM-33", FileKind::luminaire, is_tm33, true},
    FileFormat{"GLDF", FileKind::luminaire, is_gldf, true},
    FileFormat{"Wavefront OBJ", FileKind::city, is_obj, true, obj::obj_endings, &obj_reader},
};

std::string list_names() {
  std::string names;
  for (const FileFormat& format : formats)
    names += std::string(names.empty() ? "" : ", ") + format.name;
  return names;
}

}  // namespace

std::span<const FileFormat> file_formats() {
  return formats;
}

namespace {

const FileFormat* recognise(const FileStart& start) {
  const auto format = std::find_if(formats.begin(), formats.end(), [&](const FileFormat& f) {
    return (f.may_be_packed || !start.packed) && f.recognises(start);
  });
  return format == formats.end() ? nullptr : &*format;
}

// Returns the file's name, or that of an archive's entry.
std::string name_of(const city::Document& document) {
  return to_lower(std::filesystem::path(document.name).filename().string());
}

}  // namespace

city::FileContents list_readable(const std::filesystem::path& path) {
  std::vector<std::string_view> endings = city_endings();
  endings.insert(endings.end(), osm::map_endings.begin(), osm::map_endings.end());
  for (const char* of_a_luminaire : {".ies", ".ldt"}) endings.emplace_back(of_a_luminaire);
  return city::list_contents(path, endings);
}

const FileFormat& find_format(const std::filesystem::path& path) {
  return find_format(list_readable(path).documents);
}

const FileFormat& find_format(const std::vector<city::Document>& documents) {
  std::string why, where;
  const FileFormat* other = nullptr;
  for (const city::Document& document : documents) {
    const std::string bytes = city::read_start(document, start_bytes), name = name_of(document);
    const FileFormat* format = recognise({bytes, name, document.packed});
    if (format && format->kind == FileKind::city) return *format;
    if (!other) other = format;
    if (other || !why.empty()) continue;
    if (where.empty()) where = document.name;
    why = city::explain_foreign(bytes, name);
    if (why.empty()) why = osm::describe_unread_osm(bytes);
    if (!why.empty()) where = document.name;
  }
  if (other) return *other;
  throw Error(where, why.empty() ? "is of no format that is read here: " + list_names() : why);
}

const FileFormat* find_format(const city::Document& document) {
  return recognise({city::read_start(document, start_bytes), name_of(document), document.packed});
}

std::string find_reason_to_pass_over(const std::filesystem::path& path) {
  if (city::is_named_as_volume(to_lower(path.filename().string()))) return city::volume_words;
  std::vector<city::Document> documents;
  try {
    documents = list_readable(path).documents;
  } catch (const city::NothingInside& archive) {
    return archive.holds();
  }
  if (documents.size() != 1) return {};
  const city::Document& document = documents.front();
  const std::string bytes = city::read_start(document, start_bytes), name = name_of(document);
  if (const FileFormat* format = recognise({bytes, name, document.packed}))
    return format->kind == FileKind::city ? "" : std::string("is ") + format->name;
  const bool is_text = !city::find_root_name(bytes).empty() || bytes.starts_with('{');
  return is_text ? city::explain_foreign(bytes, name) : "";
}

}  // namespace nightcity::inputs
