#include "tools/bake/city_stage.h"

#include <glm/geometric.hpp>
#include <optional>
#include <string_view>
#include <unordered_map>

namespace nightcity {
namespace {

constexpr double farthest_m =
    100'000;  // a stray point beyond this would cost every other vertex its precision

// Which surfaces of an object carry a lamp post.
std::optional<Footing> footing_of(ObjectType type, SurfaceType surface) {
  switch (type) {
    case ObjectType::relief:
      return Footing::terrain;
    case ObjectType::road:
    case ObjectType::railway:
      return Footing::road;
    case ObjectType::building:
      if (surface == SurfaceType::ground) return Footing::ground_surface;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

class CityReader {
 public:
  CityReader(const Recipe& recipe, const CityFrames& frames, const CitySinks& sinks, BakeReport& report)
      : frames_(frames), sinks_(sinks), report_(report), many_files_(recipe.city.files.size() > 1) {}

  void begin_file(std::size_t file) {
    file_ = file;
    last_id_.clear();
    last_feature_ = no_id;
  }

  void take(CityObject&& object) {
    ++report_.objects[name_of(object.type)];
    if (object.polygons.empty()) return leave_out("without geometry");
    // A large object comes in pieces, one after the other, under one id.
    const bool continues = !object.id.empty() && object.id == last_id_;
    if (!continues && many_files_ && seen_before(object)) {
      last_id_.clear();
      return leave_out("in two files");
    }
    const bool flat = lacks_heights(object);
    for (Polygon& polygon : object.polygons) {
      frames_.to_city(file_, polygon.exterior);
      for (Ring& ring : polygon.interiors) frames_.to_city(file_, ring);
    }
    if (far_away(object)) return leave_out("far from the city");
    classify_unknown_surfaces(object);
    if (sinks_.windows && object.type == ObjectType::building) sinks_.windows->add(object);
    const TriangleMesh mesh = triangulate(object, report_.mesh);
    if (mesh.triangles.empty()) return leave_out("without area");
    if (!continues) last_feature_ = add_feature(object);
    last_id_ = object.id;
    if (flat) return sinks_.drape.add(mesh, object.type, last_feature_);
    add_mesh(sinks_.tiles, mesh, object.type, last_feature_);
    add_footing(mesh, object.type);
  }

 private:
  void leave_out(const char* reason) { ++report_.left_out[reason]; }

  // Neighbouring files often share the objects on their border.
  bool seen_before(const CityObject& object) {
    if (object.id.empty()) return false;
    std::string key = object.id;
    const Ring& ring = object.polygons.front().exterior;
    if (!ring.empty()) key.append(reinterpret_cast<const char*>(&ring.front()), sizeof(glm::dvec3));
    const std::size_t hash = std::hash<std::string_view>()(key);
    const auto [found, is_new] = seen_.try_emplace(hash, file_);
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

  void add_footing(const TriangleMesh& mesh, ObjectType type) {
    std::optional<Footing> footing;
    TriangleMesh part;
    part.positions = mesh.positions;
    for (const MeshTriangle& triangle : mesh.triangles)
      if (const auto carries = footing_of(type, triangle.surface)) {
        footing = carries;  // one class an object: it depends on the surface only by whether there is one
        part.triangles.push_back(triangle);
      }
    if (footing) sinks_.terrain.add(part, *footing);
  }

  const CityFrames& frames_;
  const CitySinks& sinks_;
  BakeReport& report_;
  bool many_files_;
  std::size_t file_ = 0;
  std::string last_id_;
  std::uint32_t last_feature_ = no_id;
  std::unordered_map<std::size_t, std::size_t> seen_;  // hash of an object, the file that brought it
};

}  // namespace

void add_mesh(TileStore& tiles, const TriangleMesh& mesh, ObjectType type, std::uint32_t feature) {
  std::vector<TileStore::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const MeshTriangle& triangle : mesh.triangles) {
    const SurfaceUse use = use_of(type, triangle.surface);
    const auto corner = [&](int k) { return mesh.positions[triangle.vertex[k]]; };
    triangles.push_back({{corner(0), corner(1), corner(2)}, use.material, use.kind});
  }
  tiles.add(triangles, feature);
}

void read_city(const Recipe& recipe, const CityFrames& frames, const CitySinks& sinks, BakeReport& report,
               const ProgressSink& progress) {
  const auto& files = recipe.city.files;
  CityReader reader(recipe, frames, sinks, report);
  std::size_t objects = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    reader.begin_file(i);
    const std::string stage = "reading " + std::to_string(i + 1) + " of " + std::to_string(files.size()) +
                              ": " + files[i].filename().string();
    report.read.merge(read_citygml(files[i], recipe.city.read, [&](CityObject&& object) {
      reader.take(std::move(object));
      if (progress && ++objects % 64 == 0) progress({stage, objects, "objects"});
    }));
  }
}

}  // namespace nightcity
