#include "tools/cityjson/shared_parts.h"

#include <algorithm>
#include <limits>

#include "formats/error.h"
#include "formats/to_lower.h"

namespace nightcity::cityjson {
namespace {

std::optional<glm::vec3> read_colour(const dom::element& material) {
  dom::object object;
  if (material.get(object) != simdjson::SUCCESS) return {};
  const auto value = find_member(object, "diffuseColor");
  if (!value) return {};
  const auto colour = to_vector(*value);
  if (!colour) return {};
  for (int i = 0; i < 3; ++i)
    if (!((*colour)[i] >= 0 && (*colour)[i] <= 1)) return {};
  return glm::vec3(*colour);
}

glm::dvec2 read_place(const dom::element& value) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  dom::array array;
  if (value.get(array) != simdjson::SUCCESS || array.size() < 2) return glm::dvec2(none);
  return {to_number(array.at(0).value()).value_or(none),
          to_number(array.at(1).value()).value_or(none)};
}

bool is_digits(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::string to_srs_name(std::string_view name) {
  const std::string lower = to_lower(name);
  const std::size_t authority = lower.find("epsg");
  if (authority == std::string::npos || name.find(',') != std::string_view::npos)
    return std::string(name);
  // "EPSG:28992+5709", ".../def/crs-compound?1=...&2=...": that of the heights comes second.
  std::string codes;
  for (std::string_view rest = name; !rest.empty();) {
    const std::size_t end = rest.find_first_of("+&");
    const std::string_view part = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    const std::size_t last = part.find_last_of(":/#");
    const std::string_view code = last == std::string_view::npos ? part : part.substr(last + 1);
    if (!is_digits(code)) return std::string(name);
    codes += (codes.empty() ? "EPSG:" : "+") + std::string(code);
  }
  return codes;
}

std::string find_crs_name(const dom::object& described) {
  if (const auto properties = find_object(described, "properties"))
    return to_srs_name(find_text(*properties, "name"));
  if (!find_text(described, "type").ends_with("CRS")) return {};
  if (const auto id = find_object(described, "id")) {
    const auto code = find_member(*id, "code");
    const std::string_view authority = find_text(*id, "authority");
    if (code && !authority.empty()) return std::string(authority) + ":" + to_text(*code);
  }
  return find_text(described, "name").empty() ? std::string() : simdjson::minify(described);
}

Transform read_transform(const dom::element& value, const Where& where) {
  dom::object object;
  if (value.get(object) == simdjson::SUCCESS) {
    const auto find_vector = [&](std::string_view key) {
      const auto member = find_member(object, key);
      return member ? to_vector(*member) : std::nullopt;
    };
    const auto scale = find_vector("scale"), translate = find_vector("translate");
    if (scale && translate && scale->x != 0 && scale->y != 0 && scale->z != 0)
      return {*scale, *translate};
  }
  throw Error(where(), "\"transform\" needs \"scale\" and \"translate\" of three numbers each");
}

// Flattened: calls to simdjson take longer than what they do.
[[gnu::flatten]] std::vector<glm::dvec3> read_vertices(const dom::array& array,
                                                       const Transform& transform) {
  std::vector<glm::dvec3> vertices;
  vertices.reserve(array.size());
  for (const dom::element& value : array) {
    glm::dvec3& vertex = vertices.emplace_back(std::numeric_limits<double>::quiet_NaN());
    dom::array numbers;
    if (value.get(numbers) != simdjson::SUCCESS || numbers.size() != 3) continue;
    auto number = numbers.begin();
    const auto x = to_number(*number), y = to_number(*++number), z = to_number(*++number);
    if (x && y && z) vertex = transform.apply({*x, *y, *z});
  }
  return vertices;
}

void Materials::read(const dom::object& appearance) {
  default_theme = find_text(appearance, "default-theme-material");
  default_texture_theme = find_text(appearance, "default-theme-texture");
  if (const auto materials = find_array(appearance, "materials"))
    for (const dom::element& material : *materials) colours.push_back(read_colour(material));
  if (const auto list = find_array(appearance, "textures"))
    for (const dom::element& texture : *list) {
      dom::object object;
      const bool is_object = texture.get(object) == simdjson::SUCCESS;
      picture_names.emplace_back(is_object ? find_text(object, "image") : std::string_view());
    }
  if (const auto places = find_array(appearance, "vertices-texture"))
    for (const dom::element& place : *places) texture_places.push_back(read_place(place));
}

void Materials::find_pictures(const std::string& document, const city::ReadOptions& options,
                              city::SkipCounter& skipped) {
  if (picture_names.empty()) return;
  textures = options.textures;
  if (textures == city::Textures::none)
    skipped.add("texture", picture_names.size());
  else
    pictures = std::make_shared<city::PictureShelf>(document, picture_names);
}

void SharedParts::read_templates(const dom::object& value) {
  if (const auto vertices = find_array(value, "vertices-templates"))
    template_vertices = read_vertices(*vertices, {});
  const auto array = find_array(value, "templates");
  if (!array) return;
  for (const dom::element& element : *array) {
    dom::object geometry;
    if (element.get(geometry) == simdjson::SUCCESS)
      templates.emplace_back(geometry);
    else
      templates.emplace_back();
  }
}

void SharedParts::read(std::string_view key, const dom::element& value, const Where& where,
                       city::SkipCounter& skipped) {
  dom::object object;
  const bool is_object = value.get(object) == simdjson::SUCCESS;
  if (key == "type") {
    std::string_view type;
    if (value.get(type) != simdjson::SUCCESS || type != "CityJSON")
      throw Error(where(), "is no CityJSON: its \"type\" is " +
                               (type.empty() ? "no text" : "\"" + std::string(type) + "\"") +
                               (type == "CityJSONFeature" ? ", which needs a first line of type "
                                                            "\"CityJSON\" with CRS and transform"
                                                          : ""));
    has_type_ = true;
  } else if (key == "version") {
    version = to_text(value);
    if (version == "1" || version == "2") version += ".0";  // a number: 2.0 is 2
    if (!version.starts_with("1.") && !version.starts_with("2."))
      throw Error(where(),
                  "is CityJSON " + version +
                      ", and 1.0 to 2.0 are read: turn it into one of these (cjio upgrade)");
  } else if (key == "transform" && !value.is_null()) {
    transform = read_transform(value, where);
    has_transform = true;
  } else if (key == "metadata" && is_object) {
    if (const auto said = find_member(object, "referenceSystem")) {
      dom::object described;
      if (said->get(described) == simdjson::SUCCESS)
        srs_name = find_crs_name(described);
      else
        srs_name = to_srs_name(to_text(*said));  // also of 25832, a number
      if (srs_name.empty()) skipped.add("referenceSystem that is no text");
    } else if (const auto crs = find_object(object, "crs")) {  // before 0.9, and still written
      if (const auto code = find_member(*crs, "epsg")) srs_name = "EPSG:" + to_text(*code);
    }
  } else if (key == "appearance" && is_object) {
    materials.read(object);
  } else if (key == "geometry-templates" && is_object) {
    read_templates(object);
  } else if (key == "extensions" && is_object && object.size() > 0) {
    skipped.add("extension", object.size());
  }
}

void SharedParts::require_srs_name(const std::optional<std::string>& known,
                                   const std::string& where) const {
  if (known && !srs_name.empty() && srs_name != *known)
    throw Error(where, "names another CRS (" + srs_name + ") than the first in its archive (" +
                           *known + "): unpack the archive, then each file is placed by its own");
}

void SharedParts::require_type(const std::string& where) const {
  if (!has_type_) throw Error(where, "is no CityJSON: it has no \"type\": \"CityJSON\"");
}

}  // namespace nightcity::cityjson
