#include "tools/bake/city/prepared_objects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
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
  std::string elsewhere;                    // a CRS that it names beside the file's
  std::optional<city::CityObject> unknown;  // names a CRS that is learnt in file order
};

// Calls `visit(srs_name, coordinates)` for each part of the object that names a CRS of its own.
template <typename Visit>
void for_each_named(const city::CityObject& object, const Visit& visit) {
  for (const city::Polygon& polygon : object.polygons)
    if (polygon.srs_name) visit(*polygon.srs_name, polygon.exterior);
  if (object.points_srs_name && !object.points.empty())
    visit(*object.points_srs_name, object.points);
  for (const city::Ring& line : object.lines)
    if (object.points_srs_name) visit(*object.points_srs_name, line);
}

std::size_t make_identity(const city::CityObject& object) {
  if (object.id.empty() || object.polygons.empty()) return 0;
  std::string key = object.id;
  const city::Ring& ring = object.polygons.front().exterior;
  if (!ring.empty()) key.append(reinterpret_cast<const char*>(&ring.front()), sizeof(glm::dvec3));
  return std::hash<std::string_view>()(key);
}

class CityReader {
 public:
  CityReader(CityFrames& frames, const GroundHeights* heights,
             std::span<CityConsumer* const> consumers, const CityInputs& inputs)
      : frames_(frames),
        heights_(heights),
        consumers_(consumers),
        many_files_(inputs.files.size() > 1),
        max_crossings_(inputs.read.max_crossings) {}

  void begin_file(std::size_t file) {
    file_ = file;
    last_id_.clear();
    elsewhere_.clear();
  }

  // Tells what of the file was placed by another CRS than the file's first geometry.
  void end_file(const std::filesystem::path& file) {
    for (const auto& [name, count] : elsewhere_)
      report_.read.warnings.push_back(
          file.string() + ": " + std::to_string(count) + " objects name another CRS (" + name +
          ") than the first geometry (" + frames_.srs_name_of(file_).value_or("") +
          "): they are placed by their own");
  }

  // Called in file order, for an object that prepare() has left as it was.
  void finish(Waiting& waiting, const std::filesystem::path& file) {
    if (!waiting.unknown) return;
    city::CityObject object = std::move(*waiting.unknown);
    std::map<std::string, std::vector<glm::dvec3>> samples;
    for_each_named(object, [&](const std::string& name, const city::Ring& ring) {
      std::vector<glm::dvec3>& sample = samples[name];
      sample.insert(sample.end(), ring.begin(), ring.end());
      if (!ring.empty()) sample.push_back(ring.front());
    });
    for (const auto& [name, sample] : samples)
      frames_.learn(name, sample, file.string() + ": " + object.id);
    waiting = prepare(std::move(object));
  }

  // Called on many threads.
  Waiting prepare(city::CityObject&& object) const {
    Waiting result;
    bool known = true;
    for_each_named(object, [&](const std::string& name, const city::Ring&) {
      result.elsewhere = name;
      known = known && frames_.knows(name);
    });
    if (!known) {
      result.unknown = std::move(object);
      return result;
    }
    result.identity = many_files_ ? make_identity(object) : 0;
    const auto prepared = std::make_shared<PreparedObject>();
    prepared->lacks_heights = lacks_heights(object);
    to_city_frame(object);
    if (object.polygons.empty()) {
      if (object.points.empty() && object.lines.empty()) result.left_out = "without geometry";
    } else if (is_far_away(object)) {
      result.left_out = "far from the city";
    } else if (heights_ && !stand_on_ground(object)) {
      result.left_out = "where no elevation model has a height";
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
    if (!waiting.elsewhere.empty() && !continues) ++elsewhere_[waiting.elsewhere];
    for (const CityConsumer::Turn& turn : waiting.turns) turn(continues);
    if (!waiting.prepared->mesh.triangles.empty()) last_id_ = object.id;
  }

  CityReport& report() { return report_; }

 private:
  void to_city_frame(city::CityObject& object) const {
    for (city::Polygon& polygon : object.polygons) {
      to_city_frame(polygon.srs_name.get(), polygon.exterior);
      for (city::Ring& ring : polygon.interiors) to_city_frame(polygon.srs_name.get(), ring);
    }
    to_city_frame(object.points_srs_name.get(), object.points);
    for (city::Ring& line : object.lines) to_city_frame(object.points_srs_name.get(), line);
  }

  void to_city_frame(const std::string* srs_name, std::span<glm::dvec3> coordinates) const {
    if (srs_name)
      frames_.to_city(*srs_name, coordinates);
    else
      frames_.to_city(file_, coordinates);
  }

  bool is_far_away(const city::CityObject& object) const {
    for (const city::Polygon& polygon : object.polygons)
      for (const glm::dvec3& p : polygon.exterior)
        if (glm::distance(glm::dvec2(p), glm::dvec2(frames_.reference())) > max_distance_m)
          return true;
    return false;
  }

  // Returns false where the ground below the object is unknown.
  bool stand_on_ground(city::CityObject& object) const {
    std::vector<glm::dvec2> places;
    for (const city::Polygon& polygon : object.polygons)
      for (const glm::dvec3& p : polygon.exterior) places.emplace_back(p);
    const auto before = [](const glm::dvec2& a, const glm::dvec2& b) {
      return std::make_pair(a.x, a.y) < std::make_pair(b.x, b.y);
    };
    std::sort(places.begin(), places.end(), before);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    double lowest = std::numeric_limits<double>::infinity();
    for (const double height : heights_->at(places))
      if (height < lowest) lowest = height;  // not NaN
    if (!std::isfinite(lowest)) return false;
    for (city::Polygon& polygon : object.polygons) {
      for (glm::dvec3& p : polygon.exterior) p.z += lowest;
      for (city::Ring& ring : polygon.interiors)
        for (glm::dvec3& p : ring) p.z += lowest;
    }
    return true;
  }

  // Neighbouring files often share the objects on their border.
  bool was_seen_before(std::size_t identity) {
    if (identity == 0) return false;
    const auto [found, is_new] = seen_.try_emplace(identity, file_);
    return !is_new && found->second != file_;
  }

  CityFrames& frames_;
  const GroundHeights* heights_;
  std::span<CityConsumer* const> consumers_;
  bool many_files_;
  int max_crossings_;
  CityReport report_;
  std::size_t file_ = 0;
  std::string last_id_;
  std::map<std::string, std::size_t> elsewhere_;  // objects of this file, by the CRS they name
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

CityReport read_prepared_objects(const CityInputs& inputs, CityFrames& frames,
                                 const GroundHeights* heights,
                                 std::span<CityConsumer* const> consumers,
                                 const ProgressSink& progress) {
  const auto& files = inputs.files;
  CityReader reader(frames, heights, consumers, inputs);
  city::ReadOptions options = inputs.read;
  std::set<std::filesystem::path> neighbours;
  for (const auto& file : files) neighbours.insert(file.lexically_normal());
  if (files.size() > 1)
    options.neighbours = std::make_shared<const std::set<std::filesystem::path>>(neighbours);
  std::size_t objects = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    reader.begin_file(i);
    options.srs_name = frames.srs_name_of(i);
    const std::string stage = "reading " + std::to_string(i + 1) + " of " +
                              std::to_string(files.size()) + ": " + files[i].filename().string();
    const auto prepare = [&](std::vector<city::CityObject>&& read) -> std::function<void()> {
      const auto batch = std::make_shared<std::vector<Waiting>>();
      batch->reserve(read.size());
      for (city::CityObject& object : read) batch->push_back(reader.prepare(std::move(object)));
      return [&, batch] {
        for (Waiting& waiting : *batch) {
          reader.finish(waiting, files[i]);
          reader.take(waiting);
          waiting = {};
        }
        objects += batch->size();
        if (progress) progress({stage, objects, "objects"});
      };
    };
    reader.report().read.merge(inputs::read_city_staged(files[i], options, prepare));
    reader.end_file(files[i]);
  }
  auto& warnings = reader.report().read.warnings;
  warnings.insert(warnings.begin(), frames.warnings().begin(), frames.warnings().end());
  return std::move(reader.report());
}

}  // namespace nightcity::bake
