#include "tools/bake/city/prepared_objects.h"

#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/inputs/read_city.h"
#include "tools/mesh/classify.h"
#include "tools/mesh/close_gaps.h"
#include "tools/mesh/triangulate.h"

namespace nightcity::bake {
namespace {

// A stray point beyond this would cost every other vertex its precision.
constexpr double max_distance_m = 100'000;

// An object with all the work done that needs no other object.
struct Waiting {
  std::shared_ptr<const PreparedObject> prepared;
  std::size_t identity = 0;        // of its id and first vertex; 0 = it has no id
  const char* left_out = nullptr;  // why
  mesh::MeshReport report;
  std::vector<CityConsumer::Turn> turns;
};

std::size_t make_identity(const city::CityObject& object) {
  if (object.id.empty() || object.polygons.empty()) return 0;
  std::string key = object.id;
  const city::Ring& ring = object.polygons.front().exterior;
  if (!ring.empty()) key.append(reinterpret_cast<const char*>(&ring.front()), sizeof(glm::dvec3));
  return std::hash<std::string_view>()(key);
}

class CityReader {
 public:
  CityReader(const CityFrames& frames, std::span<CityConsumer* const> consumers,
             const CityInputs& inputs)
      : frames_(frames),
        consumers_(consumers),
        many_files_(inputs.files.size() > 1),
        max_crossings_(inputs.read.max_crossings) {}

  void begin_file(std::size_t file) {
    file_ = file;
    last_id_.clear();
  }

  // Called on many threads.
  Waiting prepare(city::CityObject&& object) const {
    Waiting result;
    result.identity = many_files_ ? make_identity(object) : 0;
    const auto prepared = std::make_shared<PreparedObject>();
    prepared->lacks_heights = lacks_heights(object);
    to_city_frame(object);
    if (object.polygons.empty()) {
      if (object.points.empty() && object.lines.empty()) result.left_out = "without geometry";
    } else if (is_far_away(object)) {
      result.left_out = "far from the city";
    } else {
      // Shells first: which way is out decides what is a roof and which side of a wall has windows.
      mesh::repair_shells(object, result.report);
      mesh::classify_unknown_surfaces(object);
      prepared->mesh = mesh::triangulate(object, result.report, max_crossings_);
      if (prepared->mesh.triangles.empty()) result.left_out = "without area";
    }
    prepared->closed = object.type == city::ObjectType::building && result.report.open_objects == 0;
    prepared->object = std::move(object);
    result.prepared = prepared;
    if (!result.left_out)
      for (CityConsumer* consumer : consumers_)
        if (auto turn = consumer->prepare(prepared)) result.turns.push_back(std::move(turn));
    return result;
  }

  // Called in file order.
  void take(const Waiting& waiting) {
    const city::CityObject& object = waiting.prepared->object;
    ++report_.objects[city::name_of(object.type)];
    // A large object comes in pieces, one after the other, under one id.
    const bool continues = !object.id.empty() && object.id == last_id_;
    const char* left_out = waiting.left_out;
    if (!left_out && !continues && was_seen_before(waiting.identity)) {
      last_id_.clear();
      left_out = "in two files";
    } else {
      report_.mesh.merge(waiting.report);
    }
    if (left_out) {
      ++report_.left_out[left_out];
      return;
    }
    for (const CityConsumer::Turn& turn : waiting.turns) turn(continues);
    if (!waiting.prepared->mesh.triangles.empty()) last_id_ = object.id;
  }

  CityReport& report() { return report_; }

 private:
  void to_city_frame(city::CityObject& object) const {
    for (city::Polygon& polygon : object.polygons) {
      frames_.to_city(file_, polygon.exterior);
      for (city::Ring& ring : polygon.interiors) frames_.to_city(file_, ring);
    }
    frames_.to_city(file_, object.points);
    for (city::Ring& line : object.lines) frames_.to_city(file_, line);
  }

  bool is_far_away(const city::CityObject& object) const {
    for (const city::Polygon& polygon : object.polygons)
      for (const glm::dvec3& p : polygon.exterior)
        if (glm::distance(glm::dvec2(p), glm::dvec2(frames_.reference())) > max_distance_m)
          return true;
    return false;
  }

  // Neighbouring files often share the objects on their border.
  bool was_seen_before(std::size_t identity) {
    if (identity == 0) return false;
    const auto [found, is_new] = seen_.try_emplace(identity, file_);
    return !is_new && found->second != file_;
  }

  const CityFrames& frames_;
  std::span<CityConsumer* const> consumers_;
  bool many_files_;
  int max_crossings_;
  CityReport report_;
  std::size_t file_ = 0;
  std::string last_id_;
  std::unordered_map<std::size_t, std::size_t>
      seen_;  // identity of an object; file that brought it
};

}  // namespace

bool lacks_heights(const city::CityObject& object) {
  switch (object.type) {
    case city::ObjectType::road:
    case city::ObjectType::railway:
    case city::ObjectType::land_use:
    case city::ObjectType::water:
    case city::ObjectType::vegetation:
      break;
    default:
      return false;
  }
  for (const city::Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior)
      if (p.z != 0) return false;
  return true;
}

CityReport read_prepared_objects(const CityInputs& inputs, const CityFrames& frames,
                                 std::span<CityConsumer* const> consumers,
                                 const ProgressSink& progress) {
  const auto& files = inputs.files;
  CityReader reader(frames, consumers, inputs);
  reader.report().read.warnings = frames.warnings();
  city::ReadOptions options = inputs.read;
  std::set<std::filesystem::path> neighbours;
  for (const auto& file : files) neighbours.insert(file.lexically_normal());
  if (files.size() > 1)
    options.neighbours = std::make_shared<const std::set<std::filesystem::path>>(neighbours);
  std::size_t objects = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    reader.begin_file(i);
    const std::string stage = "reading " + std::to_string(i + 1) + " of " +
                              std::to_string(files.size()) + ": " + files[i].filename().string();
    const auto prepare = [&](std::vector<city::CityObject>&& read) -> std::function<void()> {
      const auto batch = std::make_shared<std::vector<Waiting>>();
      batch->reserve(read.size());
      for (city::CityObject& object : read) batch->push_back(reader.prepare(std::move(object)));
      return [&, batch] {
        for (Waiting& waiting : *batch) {
          reader.take(waiting);
          waiting = {};
        }
        objects += batch->size();
        if (progress) progress({stage, objects, "objects"});
      };
    };
    reader.report().read.merge(inputs::read_city_staged(files[i], options, prepare));
  }
  return std::move(reader.report());
}

}  // namespace nightcity::bake
