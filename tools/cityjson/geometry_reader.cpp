#include "tools/cityjson/geometry_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "formats/finite.h"
#include "tools/city/attributes.h"
#include "tools/city/placement_matrix.h"
#include "tools/city/ring.h"

namespace nightcity::cityjson {
namespace {

// Polygons that one object may make by templates: a few shapes placed often must not fill the
// memory.
constexpr std::size_t max_placed_polygons = 1'000'000;

// Returns how deep surfaces lie in "boundaries"; none for geometry without surfaces.
std::optional<int> find_surface_depth(std::string_view type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 0;
  if (type == "Solid") return 1;
  if (type == "MultiSolid" || type == "CompositeSolid") return 2;
  return {};
}

// Returns how many arrays the first vertex number lies in; none where there is no number.
std::optional<int> measure_nesting(const dom::element& boundaries) {
  dom::array array;
  if (boundaries.get(array) != simdjson::SUCCESS)
    return boundaries.is_number() ? std::optional(0) : std::nullopt;
  for (const dom::element& child : array)
    if (const auto inside = measure_nesting(child)) return *inside + 1;
  return {};
}

// Returns the same by how deep the boundaries are nested, where a writer mistook a type for
// another: a surface is two arrays, its rings and their vertices. Each geometry is looked at.
[[gnu::flatten]] int correct_depth(int by_type, const dom::element& boundaries) {
  dom::element at = boundaries;
  dom::array array;
  int nesting = 0;
  for (; at.get(array) == simdjson::SUCCESS; ++nesting) {
    const auto first = array.begin();
    if (!(first != array.end())) {  // an empty shell says nothing
      nesting = measure_nesting(boundaries).value_or(0);
      break;
    }
    at = *first;
  }
  return nesting >= 3 && nesting <= 5 ? nesting - 3 : by_type;
}

// A geometry's level of detail: a number in CityJSON 1.0, a text since 1.1.
std::optional<double> find_lod(const dom::object& geometry) {
  const auto value = find_member(geometry, "lod");
  if (!value) return {};
  const auto lod = city::parse_number(to_text(*value));
  return lod && *lod >= 0 && *lod < 10 ? lod : std::nullopt;
}

std::size_t count_at(const dom::element& boundaries, int depth) {
  dom::array array;
  if (boundaries.get(array) != simdjson::SUCCESS) return 0;
  if (depth == 0) return array.size();
  std::size_t count = 0;
  for (const dom::element& child : array) count += count_at(child, depth - 1);
  return count;
}

std::size_t count_its_polygons(const dom::object& geometry) {
  const auto boundaries = find_member(geometry, "boundaries");
  if (!boundaries) return 0;
  const auto depth = find_surface_depth(find_text(geometry, "type"));
  return depth ? count_at(*boundaries, correct_depth(*depth, *boundaries)) : 0;
}

// Steps through an array of values that belong to others; gives null where there is none.
class Alongside {
 public:
  explicit Alongside(const dom::element* values) {
    dom::array array;
    if (!values || values->get(array) != simdjson::SUCCESS) return;
    next_ = array.begin();
    end_ = array.end();
    valid_ = true;
  }
  const dom::element* take() {
    if (!valid_ || !(next_ != end_)) return nullptr;
    value_ = *next_;
    ++next_;
    return &value_;
  }

 private:
  dom::array::iterator next_{}, end_{};
  dom::element value_{};
  bool valid_ = false;
};

}  // namespace

bool are_usable(std::span<const glm::dvec3> vertices) {
  return std::all_of(vertices.begin(), vertices.end(), [](const glm::dvec3& vertex) {
    return finite(vertex) && !city::is_sentinel_height(vertex.z);
  });
}

std::size_t count_polygons(const dom::array& geometries) {
  std::size_t count = 0;
  for (const dom::element& element : geometries)
    if (dom::object geometry; element.get(geometry) == simdjson::SUCCESS)
      count += count_its_polygons(geometry);
  return count;
}

void list_rings(const dom::element& boundaries, std::vector<std::vector<std::size_t>>& rings) {
  dom::array array;
  if (boundaries.get(array) != simdjson::SUCCESS) return;
  std::vector<std::size_t> ring;
  for (const dom::element& child : array) {
    if (const auto index = to_index(child))
      ring.push_back(*index);
    else
      list_rings(child, rings);  // no deeper than simdjson lets a document be
  }
  if (!ring.empty()) rings.push_back(std::move(ring));
}

void GeometryReader::read(const dom::array& geometries, std::uint32_t space,
                          city::SurfaceType surface, city::RawPolygons& out) {
  placed_polygons_ = 0;
  std::map<int, double> finest;  // of each level; a geometry that is alone is the finest
  const bool several = geometries.size() > 1;
  for (const dom::element& element : geometries)
    if (dom::object geometry; several && element.get(geometry) == simdjson::SUCCESS)
      if (const auto lod = find_lod(geometry)) {
        const auto [at, is_new] = finest.try_emplace(static_cast<int>(*lod), *lod);
        at->second = std::max(at->second, *lod);
      }
  for (const dom::element& element : geometries) {
    dom::object geometry;
    if (element.get(geometry) != simdjson::SUCCESS) {
      skipped_.add("geometry that is no object");
      continue;
    }
    Context context;
    context.vertices = sources_.vertices;
    context.space = space;
    context.surface = surface;
    if (const auto lod = find_lod(geometry)) {
      context.lod = static_cast<int>(*lod);
      if (several && *lod < finest[context.lod]) {
        skipped_.add("polygon: a refined LoD, a finer one taken", count_its_polygons(geometry));
        continue;
      }
    }
    if (find_text(geometry, "type") == "GeometryInstance")
      read_instance(geometry, context, out);
    else
      read_geometry(geometry, std::move(context), out);
  }
}

void GeometryReader::read_geometry(const dom::object& geometry, Context context,
                                   city::RawPolygons& out) {
  const std::string_view type = find_text(geometry, "type");
  const auto boundaries = find_member(geometry, "boundaries");
  if (places_ && boundaries && type == "MultiPoint") return read_points(*boundaries);
  const auto by_type = find_surface_depth(type);
  if (!by_type || !boundaries) {
    skipped_.add(type.empty() ? "geometry without a type" : type);
    return;
  }
  const int depth = correct_depth(*by_type, *boundaries);
  if (depth != *by_type)
    skipped_.add("type " + std::string(type) + " of a geometry that is nested otherwise");
  read_semantics(geometry, context);
  std::optional<dom::element> values;
  if (const auto semantics = find_object(geometry, "semantics"))
    values = find_member(*semantics, "values");
  std::optional<dom::element> materials;
  if (const auto themes = find_object(geometry, "material")) {
    std::optional<dom::object> theme =
        find_object(*themes, sources_.materials ? sources_.materials->default_theme : "");
    for (const auto& [name, value] : *themes)
      if (dom::object other; !theme && value.get(other) == simdjson::SUCCESS) theme = other;
    if (theme) {
      materials = find_member(*theme, "values");
      if (const auto one = find_member(*theme, "value")) context.colour = find_colour(*one);
    }
  }
  const std::optional<dom::element> textures = find_texture_values(geometry);
  walk(*boundaries,
       {values ? &*values : nullptr, materials ? &*materials : nullptr,
        textures ? &*textures : nullptr},
       depth, context, out);
}

void GeometryReader::read_points(const dom::element& boundaries) {
  std::vector<std::vector<std::size_t>> rings;
  list_rings(boundaries, rings);
  for (const std::vector<std::size_t>& points : rings)
    for (const std::size_t index : points) {
      if (index < sources_.vertices.size() && finite(sources_.vertices[index]))
        places_->push_back(sources_.vertices[index]);
      else
        skipped_.add("point that is not in the file");
    }
}

void GeometryReader::walk(const dom::element& boundaries, const Beside& beside, int depth,
                          const Context& context, city::RawPolygons& out) {
  dom::array children;
  if (boundaries.get(children) != simdjson::SUCCESS) {
    skipped_.add("boundaries that are no array");
    return;
  }
  Alongside semantics_of(beside.semantics), materials_of(beside.material),
      textures_of(beside.texture);
  if (depth == 0) out.make_room(children.size());
  for (const dom::element& child : children) {
    const Beside its{semantics_of.take(), materials_of.take(), textures_of.take()};
    if (depth == 0)
      read_surface(child, its, context, out);
    else
      walk(child, its, depth - 1, context, out);
  }
}

// A template placed by a 4 x 4 matrix, in rows, and a reference point added to it.
void GeometryReader::read_instance(const dom::object& geometry, const Context& context,
                                   city::RawPolygons& out) {
  glm::dvec3 anchor{0};
  const auto matrix = read_placement(geometry, anchor);
  if (!matrix) return;
  if (places_) places_->push_back(glm::dvec3((*matrix)[3]));
  const auto number = find_member(geometry, "template");
  const auto index = number ? to_index(*number) : std::nullopt;
  if (!index || *index >= sources_.shared->templates.size() || !sources_.shared->templates[*index])
    return skipped_.add("template that is not there");
  const dom::object& shape = *sources_.shared->templates[*index];
  placed_polygons_ += count_its_polygons(shape);
  if (placed_polygons_ > max_placed_polygons)
    return skipped_.add("templates: more polygons than an object may have");
  Context placed = context;
  placed.vertices = sources_.shared->template_vertices;
  if (const auto lod = find_lod(shape)) placed.lod = static_cast<int>(*lod);
  const std::size_t first = out.size();
  read_geometry(shape, std::move(placed), out);
  const auto place = [&](city::Ring& ring) {
    for (glm::dvec3& p : ring) p = glm::dvec3(*matrix * glm::dvec4(p, 1.0));
  };
  for (std::size_t i = first; i < out.size(); ++i) {
    out[i].anchor = anchor;
    place(out[i].exterior);
    for (city::Ring& ring : out[i].interiors) place(ring);
  }
}

std::optional<glm::dmat4> GeometryReader::read_placement(const dom::object& geometry,
                                                         glm::dvec3& anchor) {
  std::vector<std::vector<std::size_t>> places;
  if (const auto boundaries = find_member(geometry, "boundaries")) list_rings(*boundaries, places);
  if (places.size() != 1 || places[0].size() != 1 || places[0][0] >= sources_.vertices.size() ||
      !finite(sources_.vertices[places[0][0]])) {
    skipped_.add("template placed nowhere");
    return {};
  }
  glm::dmat4 matrix(1.0);
  if (const auto rows = find_array(geometry, "transformationMatrix")) {
    std::array<double, 16> entries;
    std::size_t count = 0;
    bool valid = true;
    for (const dom::element& value : *rows) {
      const auto entry = to_number(value);
      valid = entry && count < 16;
      if (!valid) break;
      entries[count++] = *entry;
    }
    const auto placement =
        valid && count == 16 ? city::make_placement(entries) : std::optional<glm::dmat4>();
    if (!placement) {
      skipped_.add("template with a matrix that is none");
      return {};
    }
    matrix = *placement;
  }
  anchor = sources_.vertices[places[0][0]];
  matrix[3] += glm::dvec4(anchor, 0.0);
  return matrix;
}

}  // namespace nightcity::cityjson
