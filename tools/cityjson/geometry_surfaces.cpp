// The surfaces of a geometry: their rings, what they are, their colours and pictures.
#include <optional>
#include <string>
#include <utility>

#include "formats/finite.h"
#include "tools/city/attributes.h"
#include "tools/city/ring.h"
#include "tools/cityjson/cityjson_types.h"
#include "tools/cityjson/geometry_reader.h"

namespace nightcity::cityjson {

std::optional<dom::element> GeometryReader::find_texture_values(const dom::object& geometry) {
  const auto themes = find_object(geometry, "texture");
  if (!themes || themes->size() == 0) return {};
  if (!sources_.materials || !sources_.materials->pictures) {
    skipped_.add("texture of a geometry");
    return {};
  }
  std::optional<dom::object> theme =
      find_object(*themes, sources_.materials->default_texture_theme);
  for (const auto& [name, value] : *themes)
    if (dom::object other; !theme && value.get(other) == simdjson::SUCCESS) theme = other;
  return theme ? find_member(*theme, "values") : std::nullopt;
}

void GeometryReader::read_semantics(const dom::object& geometry, Context& context) {
  const auto semantics = find_object(geometry, "semantics");
  const auto surfaces = semantics ? find_array(*semantics, "surfaces") : std::nullopt;
  if (!surfaces) return;
  for (const dom::element& element : *surfaces) {
    Semantics& one = context.semantics.emplace_back();
    one.surface = context.surface;
    dom::object surface;
    if (element.get(surface) != simdjson::SUCCESS) continue;
    const std::string_view type = find_text(surface, "type");
    const auto known = find_surface_class(type);
    if (!known) {
      skipped_.add("surface type " + std::string(type));
      continue;
    }
    if (known->surface != city::SurfaceType::unknown) one.surface = known->surface;
    one.interior = known->interior;
    if (one.surface != city::SurfaceType::traffic_area) continue;
    const auto function = find_member(surface, "function");
    const auto code = function ? city::parse_number(to_text(*function)) : std::nullopt;
    if (code && *code >= 1 && *code <= 65535) one.area_function = static_cast<std::uint16_t>(*code);
  }
}

const glm::vec3* GeometryReader::find_colour(const dom::element& index) const {
  const auto at = to_index(index);
  if (!at || !sources_.materials || *at >= sources_.materials->colours.size()) return nullptr;
  const std::optional<glm::vec3>& colour = sources_.materials->colours[*at];
  return colour ? &*colour : nullptr;
}

const char* GeometryReader::read_ring(const dom::element& indices,
                                      std::span<const glm::dvec3> vertices, bool all_usable,
                                      city::Ring& ring) const {
  dom::array array;
  if (indices.get(array) != simdjson::SUCCESS) return "ring that is no array";
  ring.reserve(array.size());
  for (const dom::element& value : array) {
    const auto index = to_index(value);
    if (!index) return "ring with a vertex number that is none";
    if (*index >= vertices.size()) return "ring with a vertex that is not in the file";
    const glm::dvec3& vertex = vertices[*index];
    if (!all_usable && !finite(vertex)) return "ring with coordinates that are no numbers";
    ring.push_back(vertex);
  }
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  return ring.size() < 3 ? "ring of fewer than three vertices" : nullptr;
}

void GeometryReader::read_surface(const dom::element& rings, const Beside& beside,
                                  const Context& context, city::RawPolygons& out) {
  city::Polygon& polygon = out.add({context.lod, context.space});
  if (!read_polygon(rings, beside, context, polygon))
    out.drop_last();
  else if (beside.texture)
    read_texture(*beside.texture, polygon);
}

bool GeometryReader::skip(std::string_view reason) {
  skipped_.add(reason);
  return false;
}

// The values of a surface are those of its rings: the number of the picture, then that of a place
// in it for each vertex. [[null]] stands for a surface without a texture.
void GeometryReader::read_texture(const dom::element& rings, city::Polygon& polygon) {
  const Materials& materials = *sources_.materials;
  dom::array array;
  if (rings.get(array) != simdjson::SUCCESS) return;
  std::optional<std::size_t> picture;
  std::vector<glm::dvec2> places;
  for (const dom::element& element : array) {
    dom::array values;
    if (element.get(values) != simdjson::SUCCESS) return;
    bool is_first = true;
    for (const dom::element& value : values) {
      const auto number = to_index(value);
      if (!number && is_first) return;
      if (!number || (!is_first && *number >= materials.texture_places.size()))
        return skipped_.add("texture: a place in its picture that is not there");
      if (!is_first)
        places.push_back(materials.texture_places[*number]);
      else if (picture && *picture != *number)
        return skipped_.add("texture: several pictures on one surface");
      else
        picture = number;
      is_first = false;
    }
  }
  if (!picture) return;
  if (places.size() != city::count_vertices(polygon)) return skipped_.add(city::texture_misfit);
  const char* why = nullptr;
  const auto found = materials.pictures->find(*picture, why);
  if (!found) return skipped_.add(why);
  city::lay_picture(*found, places, materials.textures, polygon, pixels_left_, skipped_);
}

// Flattened: calls to simdjson take longer than what they do.
[[gnu::flatten]] bool GeometryReader::read_polygon(const dom::element& rings, const Beside& beside,
                                                   const Context& context, city::Polygon& polygon) {
  polygon.surface = context.surface;
  if (beside.semantics && !beside.semantics->is_null()) {
    const auto index = to_index(*beside.semantics);
    if (!index || *index >= context.semantics.size()) {
      skipped_.add("semantics of a surface that is not there");
    } else {
      const Semantics& meaning = context.semantics[*index];
      if (meaning.interior) return skip("polygon: inside a building");
      polygon.surface = meaning.surface;
      polygon.area_function = meaning.area_function;
    }
  }
  const glm::vec3* colour = beside.material ? find_colour(*beside.material) : nullptr;
  if (!colour) colour = context.colour;
  if (colour) polygon.diffuse_colour = *colour;
  dom::array array;
  if (rings.get(array) != simdjson::SUCCESS || array.size() == 0)
    return skip("polygon: without rings");
  const bool placed = context.vertices.data() != sources_.vertices.data();
  const bool all_usable = sources_.all_usable && !placed;
  bool outer = true;
  for (const dom::element& element : array) {
    city::Ring& ring = outer ? polygon.exterior : polygon.interiors.emplace_back();
    if (const char* fault = read_ring(element, context.vertices, all_usable, ring)) {
      if (outer) return skip("polygon: " + std::string(fault));
      skipped_.add("hole: " + std::string(fault));
      polygon.interiors.pop_back();
    }
    outer = false;
  }
  if (!all_usable && !placed && city::has_sentinel_height(polygon))
    return skip("polygon: at a height that stands for none (-9999 and the like)");
  return true;
}

}  // namespace nightcity::cityjson
