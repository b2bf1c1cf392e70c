#include "tools/obj/group_reader.h"

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "formats/checksum.h"
#include "formats/error.h"
#include "tools/city/attributes.h"
#include "tools/obj/object_kinds.h"

namespace nightcity::obj {
namespace {

// An object of more comes in pieces; a connected one may be as large as the file.
constexpr std::size_t max_faces = 200'000;

bool is_surface_of_parameters(std::string_view key) {
  return key == "curv" || key == "curv2" || key == "surf" || key == "cstype" || key == "parm";
}

}  // namespace

void Faces::add(const Faces& other, std::size_t face) {
  const std::size_t begin = face == 0 ? 0 : other.ends[face - 1];
  corners.insert(corners.end(), other.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                 other.corners.begin() + static_cast<std::ptrdiff_t>(other.ends[face]));
  if (!other.places.empty())
    places.insert(places.end(), other.places.begin() + static_cast<std::ptrdiff_t>(begin),
                  other.places.begin() + static_cast<std::ptrdiff_t>(other.ends[face]));
  ends.push_back(static_cast<std::uint32_t>(corners.size()));
  materials.push_back(other.materials[face]);
  kinds.push_back(other.kinds[face]);
}

city::ObjectType Faces::find_common_kind() const {
  const bool differ =
      std::adjacent_find(kinds.begin(), kinds.end(), std::not_equal_to<>()) != kinds.end();
  return kinds.empty() || differ ? city::ObjectType::building : kinds.front();
}

GroupReader::GroupReader(const city::Document& document, const Vertices& vertices)
    : vertices_(vertices), lines_(document.open(), document.name) {
  if (!document.packed) folder_of_ = document.name;
}

bool GroupReader::begins_object(std::string_view key) const {
  return (key == "o" && vertices_.grouping == Grouping::by_object) ||
         (key == "g" && vertices_.grouping == Grouping::by_group);
}

std::optional<Faces> GroupReader::next() {
  const bool in_pieces = vertices_.grouping != Grouping::by_connection;
  for (std::string_view line; !is_over_;) {
    if (!lines_.next(line)) {
      is_over_ = true;
      break;
    }
    const std::string_view key = take_word(line);
    if (key == "f" || key == "fo") {  // an old spelling
      read_face(line);
      if (in_pieces && current_.size() >= max_faces) return give(true);
    } else if (begins_object(key)) {
      std::string name(city::trim(line));
      if (name == current_.name) continue;
      std::optional<Faces> whole;
      if (current_.size() > 0) whole = give(false);
      current_.name = std::move(name);
      goes_on_ = false;
      if (whole) return whole;
    } else if (!in_pieces && (key == "o" || (key == "g" && current_.name.empty()))) {
      current_.name = city::trim(line);  // the only one of the file
    } else {
      take_statement(key, line);
    }
  }
  if (current_.size() == 0) return {};
  return give(false);
}

Faces GroupReader::give(bool goes_on) {
  Faces out = std::exchange(current_, {});
  out.continued = goes_on_;
  goes_on_ = goes_on;
  if (goes_on) current_.name = out.name;
  faces_ += out.size();
  return out;
}

void GroupReader::take_statement(std::string_view key, std::string_view rest) {
  if (key == "v") {
    ++seen_vertices_;
    double number = 0;
    int numbers = 0;
    while (take_number(rest, number)) ++numbers;
    if (numbers >= 6) skipped_.add("colour of a vertex");
  } else if (key == "vt") {
    ++seen_texture_places_;
  } else if (key == "usemtl") {
    const auto known = materials_.find(std::string(city::trim(rest)));
    material_ = known == materials_.end() ? nullptr : known->second;
    kind_ = find_material_type(city::trim(rest));
    if (material_ && material_->texture && !vertices_.keeps_texture_places)
      skipped_.add("texture (map_Kd) of usemtl");
  } else if (key == "mtllib") {
    read_library(rest);
  } else if (key == "l" || key == "p") {
    skipped_.add(key == "l" ? "line (l)" : "point (p)");
  } else if (is_surface_of_parameters(key)) {
    skipped_.add("curve or surface of parameters (" + std::string(key) + ")");
  }
}

void GroupReader::read_library(std::string_view names) {
  if (folder_of_.empty()) {
    warnings_.push_back(lines_.name() + ": packed, so no colours are read from " +
                        std::string(names));
    return;
  }
  std::vector<std::string> absent;
  for (const std::filesystem::path& file : find_libraries(folder_of_, names, absent)) {
    const auto [library, is_new] = libraries_.try_emplace(file.lexically_normal());
    if (!is_new) continue;
    read_materials(file, folder_of_.parent_path(), library->second);
    for (const auto& [name, material] : library->second) materials_[name] = &material;
  }
  for (const std::string& name : absent)
    warnings_.push_back(lines_.name() + ":" + std::to_string(lines_.number()) +
                        ": the material library " + name +
                        " does not lie beside the file: its colours are absent");
}

// "7", "7/1", "7//2" or "7/1/2"; a negative number counts back from the last vertex so far.
std::uint32_t GroupReader::to_vertex(std::string_view word) const {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = end == word.data() + word.size() || *end == '/';
  const auto seen = static_cast<std::int64_t>(seen_vertices_);
  const std::int64_t at = number < 0 ? seen + number : number - 1;
  if (error != std::errc() || !whole || number == 0 || at < 0 ||
      at >= static_cast<std::int64_t>(vertices_.places.size()))
    throw Error(lines_.name(), lines_.number(),
                "a face refers to vertex \"" + std::string(word.substr(0, 40)) +
                    "\", which is not there: the file has " +
                    std::to_string(vertices_.places.size()));
  return static_cast<std::uint32_t>(at);
}

// Returns no_place where the corner has no place in a picture, or none that is there.
std::uint32_t GroupReader::to_texture_place(std::string_view word) const {
  const std::size_t slash = word.find('/');
  if (slash == std::string_view::npos) return no_place;
  std::int64_t number = 0;
  const char *first = word.data() + slash + 1, *last = word.data() + word.size();
  const auto [end, error] = std::from_chars(first, last, number);
  const auto seen = static_cast<std::int64_t>(seen_texture_places_);
  const std::int64_t at = number < 0 ? seen + number : number - 1;
  if (error != std::errc() || (end != last && *end != '/') || number == 0 || at < 0 ||
      at >= static_cast<std::int64_t>(vertices_.texture_places.size()))
    return no_place;
  return static_cast<std::uint32_t>(at);
}

void GroupReader::read_face(std::string_view rest) {
  const std::size_t begin = current_.corners.size();
  for (std::string_view word; !(word = take_word(rest)).empty() && word.front() != '#';) {
    current_.corners.push_back(to_vertex(word));
    if (vertices_.keeps_texture_places) current_.places.push_back(to_texture_place(word));
  }
  if (current_.corners.size() - begin < 3) {
    current_.corners.resize(begin);
    if (vertices_.keeps_texture_places) current_.places.resize(begin);
    skipped_.add("polygon: of fewer than three vertices");
    return;
  }
  if (current_.corners.size() > std::numeric_limits<std::uint32_t>::max() / 2)
    throw Error(lines_.name(), lines_.number(), "an object has too many faces");
  current_.ends.push_back(static_cast<std::uint32_t>(current_.corners.size()));
  current_.materials.push_back(material_);
  current_.kinds.push_back(kind_);
}

namespace {

// Sets of places that hang together (union by the least number, so that the result does not depend
// on the order of joining).
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Many programs write a vertex anew for every face.
void join_same_places(const std::vector<glm::dvec3>& places, Sets& sets) {
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  const auto key = [&](std::uint32_t i) {
    return std::make_tuple(places[i].x, places[i].y, places[i].z);
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (places[order[i]] == places[order[i - 1]]) sets.join(order[i], order[i - 1]);
}

// Returns a name that is the same wherever the part lies in a file, and another for each part: a
// number within the file would take parts of several files for one, and give each the same windows.
std::string name_by_shape(const Faces& part, const Vertices& vertices) {
  std::vector<glm::dvec3> corners;
  for (const std::uint32_t corner : part.corners) corners.push_back(vertices.places[corner]);
  char text[40];
  std::snprintf(text, sizeof text, "part %016" PRIx64,
                checksum(corners.data(), corners.size() * sizeof(glm::dvec3)));
  return text;
}

// Splits the faces of one kind, or all of them. `sets`: of the vertices in one place.
void split_kind(const Faces& faces, Sets sets, std::optional<city::ObjectType> kind,
                std::vector<Faces>& parts) {
  const auto begin_of = [&](std::size_t face) { return face == 0 ? 0 : faces.ends[face - 1]; };
  for (std::size_t face = 0; face < faces.size(); ++face)
    if (!kind || faces.kinds[face] == *kind)
      for (std::size_t i = begin_of(face); i < faces.ends[face]; ++i)
        sets.join(faces.corners[begin_of(face)], faces.corners[i]);
  std::map<std::uint32_t, std::size_t> part_of;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (kind && faces.kinds[face] != *kind) continue;
    const std::uint32_t set = sets.find(faces.corners[begin_of(face)]);
    const auto [part, is_new] = part_of.try_emplace(set, parts.size());
    if (is_new) parts.emplace_back();
    parts[part->second].add(faces, face);
  }
}

}  // namespace

std::vector<Faces> split_by_connection(const Faces& faces, const Vertices& vertices) {
  Sets sets(vertices.places.size());
  join_same_places(vertices.places, sets);
  std::vector<Faces> parts;
  // The ground under houses must not make one of them where nothing has a name.
  if (!faces.name.empty())
    split_kind(faces, std::move(sets), {}, parts);
  else
    for (const city::ObjectType kind : std::set(faces.kinds.begin(), faces.kinds.end()))
      split_kind(faces, sets, kind, parts);
  for (Faces& part : parts)
    part.name =
        parts.size() == 1 && !faces.name.empty() ? faces.name : name_by_shape(part, vertices);
  return parts;
}

}  // namespace nightcity::obj
