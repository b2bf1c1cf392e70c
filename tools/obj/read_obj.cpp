#include "tools/obj/read_obj.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "tools/city/cut_picture.h"
#include "tools/city/length_unit.h"
#include "tools/city/merge_parts.h"
#include "tools/city/text_encoding.h"
#include "tools/in_order.h"
#include "tools/obj/face_pictures.h"
#include "tools/obj/group_reader.h"
#include "tools/obj/level_in_name.h"
#include "tools/obj/object_kinds.h"
#include "tools/obj/text_lines.h"
#include "tools/obj/unit_comment.h"
#include "tools/obj/vertices.h"

namespace nightcity::obj {
namespace {

constexpr std::size_t faces_a_batch = 4096;

// Gives out objects in file order, several small ones at a time.
class ObjectSource {
 public:
  ObjectSource(const city::Document& document, const Vertices& vertices, bool one_by_one)
      : vertices_(vertices),
        groups_(document, vertices),
        faces_a_batch_(one_by_one ? 1 : faces_a_batch) {}

  std::optional<std::vector<Faces>> next() {
    std::vector<Faces> batch;
    std::size_t faces = 0;
    while (faces < faces_a_batch_) {
      std::optional<Faces> one = take();
      if (!one) break;
      faces += one->size();
      batch.push_back(std::move(*one));
    }
    return batch.empty() ? std::nullopt : std::optional(std::move(batch));
  }

  const GroupReader& groups() const { return groups_; }

 private:
  std::optional<Faces> take() {
    if (vertices_.grouping != Grouping::by_connection) return groups_.next();
    if (!is_split_) {
      is_split_ = true;
      if (const auto all = groups_.next()) parts_ = split_by_connection(*all, vertices_);
    }
    if (next_part_ == parts_.size()) return {};
    return std::exchange(parts_[next_part_++], {});
  }

  const Vertices& vertices_;
  GroupReader groups_;
  std::size_t faces_a_batch_;
  std::vector<Faces> parts_;
  std::size_t next_part_ = 0;
  bool is_split_ = false;
};

struct Batch {
  city::ReadReport report;
  std::function<void()> rest;
};

city::RawObject to_raw(const Faces& faces, const Vertices& vertices, const FacePictures* pictures,
                       city::ReadReport& report) {
  city::RawObject raw;
  raw.object.id = faces.name;
  const auto named = find_named_type(faces.name);
  raw.object.type = named.value_or(faces.find_common_kind());
  raw.object.class_name = "object";
  raw.object.continues = faces.continued;
  if (raw.object.type != city::ObjectType::building && !faces.continued)
    ++report.assumed["kind of an object, by its " + std::string(named ? "name: " : "material: ") +
                     name_of(raw.object.type)];
  std::size_t at = 0;
  std::vector<std::uint32_t> places;  // of the polygon's vertices, in pictures
  std::int64_t pixels_left = city::max_object_pixels;
  city::SkipCounter skipped;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    city::Polygon polygon;
    places.clear();
    for (; at < faces.ends[face]; ++at) {
      const glm::dvec3& p = vertices.places[faces.corners[at]];
      if (!polygon.exterior.empty() && polygon.exterior.back() == p) continue;
      polygon.exterior.push_back(p);
      places.push_back(faces.places.empty() ? no_place : faces.places[at]);
    }
    while (polygon.exterior.size() > 1 && polygon.exterior.front() == polygon.exterior.back()) {
      polygon.exterior.pop_back();
      places.pop_back();
    }
    if (polygon.exterior.size() < 3) {
      ++report.skipped["polygon: of fewer than three vertices"];
      continue;
    }
    if (raw.object.type == city::ObjectType::relief) polygon.surface = city::SurfaceType::terrain;
    if (const Material* material = faces.materials[face]) {
      polygon.diffuse_colour = material->colour;
      if (pictures && material->texture)
        pictures->lay(*material->texture, places, polygon, pixels_left, skipped);
    }
    raw.polygons.add(std::move(polygon), {});
  }
  skipped.merge_into(report.skipped);
  return raw;
}

// Metres and millimetres are told apart by anyone who knows the city.
std::string describe_size(const city::Document& document, const Vertices& vertices) {
  if (vertices.places.empty()) return {};
  glm::dvec3 low = vertices.places.front(), high = low;
  for (const glm::dvec3& p : vertices.places) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec3 size = high - low;
  char text[120];
  std::snprintf(text, sizeof text, ": so it is %.4g m wide, %.4g m long and %.4g m high", size.x,
                size.y, size.z);
  const std::string unit = find_unit_comment(document);
  const auto metres = city::find_metres_per(unit);
  if (unit.empty() || metres == 1.0) return text;
  std::string comment = "; a comment in it names the unit \"" + city::decode_text(unit) + "\"";
  if (metres) {
    char number[60];
    std::snprintf(number, sizeof number, ": [city] obj_unit_m = %.9g", *metres);
    comment += number;
  }
  return text + comment;
}

void tell_placement(const city::Document& document, const Vertices& vertices,
                    const city::ReadOptions& options, city::ReadReport& report) {
  const char* axis = vertices.y_up ? "y" : "z";
  if (!vertices.up_is_said)
    report.warnings.push_back(document.name +
                              ": an OBJ does not say which axis points up: " + std::string(axis) +
                              " is taken, along which the model is less high than wide "
                              "([city] obj_up says it)");
  if (options.mesh.unit_m == 1 && options.mesh.origin == glm::dvec3(0))
    report.warnings.push_back(
        document.name +
        ": an OBJ names neither unit nor place: its coordinates are taken as metres of the city's "
        "system ([city] obj_unit_m and obj_origin say otherwise)" +
        describe_size(document, vertices));
  if (report.objects == 0)
    report.warnings.push_back(document.name +
                              ": has vertices and no faces: points have no surface that is seen");
  if (vertices.grouping == Grouping::by_connection)
    report.warnings.push_back(document.name +
                              ": names no parts (o, g): faces that hang together are one building");
}

// Lists the documents of which none shows what another shows in a better level of detail.
struct Listed {
  std::vector<city::Document> documents;
  std::size_t lower_levels = 0;  // that were left out
};

Listed list_best_levels(const std::filesystem::path& file, int max_lod) {
  Listed listed;
  std::vector<city::Document> all = city::list_documents(file, obj_endings);
  std::vector<std::string> names;
  for (const city::Document& document : all) names.push_back(document.name);
  const std::vector<bool> read = find_best_levels(names, max_lod);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (read[i])
      listed.documents.push_back(std::move(all[i]));
    else
      ++listed.lower_levels;
  return listed;
}

}  // namespace

bool begins_as_obj(std::string_view start) {
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  int statements = 0;
  bool goes_on = false;  // a backslash has the line go on with the next
  while (!start.empty()) {
    const std::size_t end = std::min(start.find_first_of("\r\n"), start.size());
    std::string_view line = start.substr(0, end);
    const bool whole = end < start.size();
    start.remove_prefix(std::min(end + 1, start.size()));
    if (std::exchange(goes_on, line.ends_with('\\') || (goes_on && line.empty()))) continue;
    const std::string_view key = take_word(line);
    if (key.empty() || key.front() == '#') continue;
    double number = 0;
    if (key == "v" || key == "vt" || key == "vn") {
      // Some writers give places on a picture that are no numbers.
      if (!take_number(line, number) && key == "v") return !whole && statements > 0;
      if (++statements == 3) return true;
    } else if (key == "mtllib" || key == "o" || key == "g" || key == "usemtl" || key == "s") {
      if (key == "mtllib" && ++statements > 0) return true;
    } else {
      return key == "f" && statements > 0;
    }
  }
  return statements > 0;
}

city::CityHead read_obj_head(const std::filesystem::path& file, const city::ReadOptions& options) {
  constexpr std::size_t enough = 4096;
  city::CityHead head;
  for (const city::Document& document : list_best_levels(file, options.max_lod).documents) {
    const bool knows_up = options.mesh.up != city::MeshPlacement::Up::automatic;
    Vertices vertices = read_vertices(document, options, knows_up ? enough : 0);
    if (vertices.places.empty()) continue;
    vertices.places.resize(std::min(vertices.places.size(), enough));
    head.sample = std::move(vertices.places);
    break;
  }
  return head;
}

city::ReadReport read_obj_document(const city::Document& document, const city::ReadOptions& options,
                                   const city::ObjectStage& stage) {
  const Vertices vertices = read_vertices(document, options);
  std::optional<FacePictures> pictures;
  if (vertices.keeps_texture_places) pictures.emplace(document, vertices, options.textures);
  ObjectSource source(document, vertices, options.passes_one_by_one());
  city::ReadReport report;
  in_order(
      options.threads, [&] { return source.next(); },
      [&](std::vector<Faces>&& batch) {
        Batch result;
        std::vector<city::CityObject> objects;
        for (const Faces& faces : batch)
          objects.push_back(city::merge_parts(
              to_raw(faces, vertices, pictures ? &*pictures : nullptr, result.report), options,
              result.report));
        result.rest = stage(std::move(objects));
        return result;
      },
      [&](Batch&& batch) {
        if (batch.rest) batch.rest();
        report.merge(batch.report);
      });
  source.groups().skipped().merge_into(report.skipped);
  for (const std::string& warning : source.groups().warnings()) report.warnings.push_back(warning);
  tell_placement(document, vertices, options, report);
  return report;
}

city::ReadReport read_obj_staged(const std::filesystem::path& file,
                                 const city::ReadOptions& options, const city::ObjectStage& stage) {
  city::ReadReport report;
  const Listed listed = list_best_levels(file, options.max_lod);
  for (const city::Document& document : listed.documents)
    report.merge(read_obj_document(document, options, stage));
  if (listed.lower_levels > 0)
    report.passed_over["Wavefront OBJ in a lower level of detail"] += listed.lower_levels;
  city::finish_report(file, report);
  return report;
}

}  // namespace nightcity::obj
