#include "tools/bake/city/city_reader.h"

#include <array>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/inputs/read_city.h"

namespace nightcity {
namespace {

constexpr double farthest_m =
    100'000;  // a stray point beyond this would cost every other vertex its precision

// What an object's surfaces are to whoever stands on, under or within them.
std::optional<Footing> footing_of(ObjectType type, SurfaceType surface) {
  switch (type) {
    case ObjectType::relief:
      return Footing::terrain;
    case ObjectType::road:
    case ObjectType::railway:
      return Footing::road;
    case ObjectType::building:
      if (surface == SurfaceType::ground) return Footing::ground_surface;
      if (surface == SurfaceType::roof) return Footing::roof;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

// An object as it comes out of the parallel part of the work: all that needs no other object.
struct Prepared {
  CityObject object;
  std::size_t identity = 0;        // of its id and first vertex; 0 = it has no id
  const char* left_out = nullptr;  // why
  bool flat = false;               // lacks heights: goes onto the terrain later
  std::vector<TileStore::Triangle> triangles;
  std::size_t dropped = 0;            // triangles, on the recipe's request
  std::array<TriangleMesh, 4> parts;  // of it by Footing
  WindowLayout::Laid windows;
  MeshReport report;
};

std::size_t identity_of(const CityObject& object) {
  if (object.id.empty() || object.polygons.empty()) return 0;
  std::string key = object.id;
  const Ring& ring = object.polygons.front().exterior;
  if (!ring.empty()) key.append(reinterpret_cast<const char*>(&ring.front()), sizeof(glm::dvec3));
  return std::hash<std::string_view>()(key);
}

std::vector<TileStore::Triangle> tile_triangles(const TriangleMesh& mesh, const CityObject& object,
                                                bool drop_ground = false) {
  std::vector<TileStore::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const MeshTriangle& triangle : mesh.triangles) {
    if (drop_ground && triangle.surface == SurfaceType::ground) continue;
    const SurfaceUse use = use_of(object.type, triangle.surface);
    const auto corner = [&](int k) { return mesh.positions[triangle.vertex[k]]; };
    TileStore::Triangle& made = triangles.emplace_back();
    for (int k = 0; k < 3; ++k) made.corners[k] = corner(k);
    made.material = code_of(use.material);
    made.kind = use.kind;
    if (triangle.polygon < object.polygons.size())
      if (const auto& colour = object.polygons[triangle.polygon].diffuse_colour)
        made.material = code_of(use.material, *colour);
  }
  return triangles;
}

class CityReader {
 public:
  CityReader(const Recipe& recipe, const CityFrames& frames, const CitySinks& sinks,
             BakeReport& report)
      : frames_(frames),
        sinks_(sinks),
        report_(report),
        many_files_(recipe.city.files.size() > 1),
        drop_ground_(recipe.city.drop_ground) {}

  void begin_file(std::size_t file) {
    file_ = file;
    last_id_.clear();
    last_feature_ = no_id;
  }

  // On many threads.
  Prepared prepare(CityObject&& object) const {
    Prepared out;
    out.identity = many_files_ ? identity_of(object) : 0;
    out.flat = lacks_heights(object);
    for (Polygon& polygon : object.polygons) {
      frames_.to_city(file_, polygon.exterior);
      for (Ring& ring : polygon.interiors) frames_.to_city(file_, ring);
    }
    frames_.to_city(file_, object.points);
    for (Ring& line : object.lines) frames_.to_city(file_, line);
    if (object.polygons.empty()) {
      if (object.points.empty() && object.lines.empty()) out.left_out = "without geometry";
    } else if (far_away(object)) {
      out.left_out = "far from the city";
    } else {
      // Shells first: which way is out decides what is a roof and which side of a wall has windows.
      repair_shells(object, out.report);
      classify_unknown_surfaces(object);
      const TriangleMesh mesh = triangulate(object, out.report);
      if (mesh.triangles.empty()) out.left_out = "without area";
      find_footing(object.type, mesh, out);
      const bool drop = drop_ground_ && object.type == ObjectType::building;
      out.triangles = tile_triangles(mesh, object, drop);
      out.dropped = mesh.triangles.size() - out.triangles.size();
    }
    if (sinks_.windows && !out.left_out) out.windows = sinks_.windows->lay(object);
    if (!sinks_.roads) object.polygons = {};
    out.object = std::move(object);
    return out;
  }

  // In file order.
  void take(Prepared&& prepared) {
    const CityObject& object = prepared.object;
    ++report_.objects[name_of(object.type)];
    // A large object comes in pieces, one after the other, under one id.
    const bool continues = !object.id.empty() && object.id == last_id_;
    if (prepared.left_out == nullptr && !continues && seen_before(prepared.identity)) {
      last_id_.clear();
      prepared.left_out = "in two files";
    } else {
      report_.mesh.merge(prepared.report);
    }
    if (prepared.left_out) {
      ++report_.left_out[prepared.left_out];
      return;
    }
    sinks_.terrain.add_points(object.points);
    report_.relief_points += object.points.size();
    for (const Ring& line : object.lines) {
      report_.relief_points += line.size();
      if (!sinks_.terrain.add_break_line(line))
        ++report_.left_out["break lines of which the vertices alone are used"];
    }
    if (prepared.dropped > 0)
      report_.left_out["triangles of ground under buildings"] += prepared.dropped;
    if (prepared.dropped == 0 && prepared.triangles.empty()) return;  // points alone
    if (sinks_.windows) sinks_.windows->add(object, std::move(prepared.windows));
    if (sinks_.roads) sinks_.roads->add(object);
    if (!continues) last_feature_ = add_feature(object);
    last_id_ = object.id;
    if (prepared.flat) return sinks_.drape.add(prepared.triangles, last_feature_);
    const bool solid = object.type == ObjectType::building && prepared.report.open_objects == 0;
    sinks_.tiles.add(prepared.triangles, last_feature_, solid);
    for (std::size_t n = 0; n < prepared.parts.size(); ++n)
      if (!prepared.parts[n].triangles.empty())
        sinks_.terrain.add(prepared.parts[n], static_cast<Footing>(n));
  }

 private:
  // Neighbouring files often share the objects on their border.
  bool seen_before(std::size_t identity) {
    if (identity == 0) return false;
    const auto [found, is_new] = seen_.try_emplace(identity, file_);
    return !is_new && found->second != file_;
  }

  bool far_away(const CityObject& object) const {
    for (const Polygon& polygon : object.polygons)
      for (const glm::dvec3& p : polygon.exterior)
        if (glm::distance(glm::dvec2(p), glm::dvec2(frames_.reference())) > farthest_m) return true;
    return false;
  }

  std::uint32_t add_feature(const CityObject& object) {
    SceneFeature feature{object.id, object.class_name, object.function, object.measured_height_m,
                         object.storeys_above_ground};
    if (feature.function.empty()) feature.function = object.usage;
    return sinks_.writer.add_feature(feature);
  }

  static void find_footing(ObjectType type, const TriangleMesh& mesh, Prepared& out) {
    for (const MeshTriangle& triangle : mesh.triangles) {
      const auto footing = footing_of(type, triangle.surface);
      if (!footing) continue;
      TriangleMesh& part = out.parts[static_cast<std::size_t>(*footing)];
      const auto first = static_cast<std::uint32_t>(part.positions.size());
      for (const std::uint32_t v : triangle.vertex) part.positions.push_back(mesh.positions[v]);
      part.triangles.push_back({{first, first + 1, first + 2}, triangle.surface, 0});
    }
  }

  const CityFrames& frames_;
  const CitySinks& sinks_;
  BakeReport& report_;
  bool many_files_, drop_ground_;
  std::size_t file_ = 0;
  std::string last_id_;
  std::uint32_t last_feature_ = no_id;
  std::unordered_map<std::size_t, std::size_t>
      seen_;  // identity of an object, the file that brought it
};

}  // namespace

void add_mesh(TileStore& tiles, const TriangleMesh& mesh, ObjectType type, std::uint32_t feature) {
  CityObject plain;
  plain.type = type;
  tiles.add(tile_triangles(mesh, plain), feature);
}

void read_city(const Recipe& recipe, const CityFrames& frames, const CitySinks& sinks,
               BakeReport& report, const ProgressSink& progress) {
  const auto& files = recipe.city.files;
  CityReader reader(recipe, frames, sinks, report);
  ReadOptions options = recipe.city.read;
  std::set<std::filesystem::path> neighbours;
  for (const auto& file : files) neighbours.insert(file.lexically_normal());
  if (files.size() > 1)
    options.neighbours = std::make_shared<const std::set<std::filesystem::path>>(neighbours);
  std::size_t objects = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    reader.begin_file(i);
    const std::string stage = "reading " + std::to_string(i + 1) + " of " +
                              std::to_string(files.size()) + ": " + files[i].filename().string();
    report.read.merge(inputs::read_city_staged(
        files[i], options, [&](std::vector<CityObject>&& read) -> std::function<void()> {
          const auto prepared =
              std::make_shared<std::vector<Prepared>>();  // std::function copies what it holds
          prepared->reserve(read.size());
          for (CityObject& object : read) prepared->push_back(reader.prepare(std::move(object)));
          return [&, prepared] {
            for (Prepared& object : *prepared) reader.take(std::move(object));
            objects += prepared->size();
            if (progress) progress({stage, objects, "objects"});
          };
        }));
  }
}

}  // namespace nightcity
