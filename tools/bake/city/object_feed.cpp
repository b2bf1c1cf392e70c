#include "tools/bake/city/object_feed.h"

#include <glm/common.hpp>
#include <utility>

#include "formats/checksum.h"
#include "tools/bake/city/prepared_objects.h"

namespace nightcity::bake {
namespace {

const char* find_reason(Unusable unusable) {
  switch (unusable) {
    case Unusable::no:
      return nullptr;
    case Unusable::without_geometry:
      return "without geometry";
    case Unusable::far_away:
      return "far from the city";
    case Unusable::without_area:
      return "without area";
    case Unusable::beyond_limits:
      return "all of polygons beyond [city] max_polygon_points or max_crossings";
    case Unusable::without_ground:
      return "where no elevation model has a height";
    case Unusable::replaced_by_map:
      return "replaced by the map's ([city] roads)";
  }
  return nullptr;
}

ObjectVersion describe_version(const ReadyObject& ready, const glm::dvec3& reference) {
  const city::CityObject& object = ready.prepared->object;
  ObjectVersion version;
  version.id = checksum(object.id.data(), object.id.size());
  version.identity = ready.identity;
  version.contents = ready.contents;
  version.lod = static_cast<std::int8_t>(object.lod);
  version.type = object.type;
  const auto& positions = ready.prepared->mesh.positions;
  if (positions.empty()) return version;
  glm::dvec3 low = positions.front(), high = low;
  for (const glm::dvec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec2 least(low - reference), greatest(high - reference);
  version.box = {least.x, least.y, greatest.x, greatest.y};
  return version;
}

}  // namespace

ObjectFeed::Batch::Item ObjectFeed::prepare(ReadyObject&& ready) const {
  Batch::Item item{std::move(ready), {}, {}};
  if (item.ready.unknown || item.ready.unusable != Unusable::no) return item;
  item.version = describe_version(item.ready, frames_.reference());
  for (CityConsumer* consumer : consumers_)
    if (auto turn = consumer->prepare(item.ready.prepared)) item.turns.push_back(std::move(turn));
  return item;
}

ObjectFeed::Batch ObjectFeed::prepare(std::vector<ReadyObject>&& objects) const {
  Batch batch;
  batch.items.reserve(objects.size());
  for (ReadyObject& ready : objects) batch.items.push_back(prepare(std::move(ready)));
  return batch;
}

void ObjectFeed::begin_file(std::size_t file) {
  file_ = file;
  stage_ = describe_reading(inputs_, file);
  last_id_.clear();
  elsewhere_.clear();
}

void ObjectFeed::end_file(const city::ReadReport& read) {
  report_.read.merge(read);
  for (const auto& [name, count] : elsewhere_)
    report_.read.warnings.push_back(
        inputs_.files[file_].string() + ": " + std::to_string(count) +
        " objects name another CRS (" + name + ") than the first geometry (" +
        frames_.srs_name_of(file_).value_or("") + "): they are placed by their own");
}

CityReport ObjectFeed::finish() {
  versions_.finish();
  auto& warnings = report_.read.warnings;
  warnings.insert(warnings.begin(), frames_.warnings().begin(), frames_.warnings().end());
  return std::move(report_);
}

void ObjectFeed::take(Batch&& batch) {
  for (Batch::Item& item : batch.items) {
    if (item.ready.unknown) learn_crs(std::move(*item.ready.unknown), item);
    take(std::move(item));
    item = {};
  }
  taken_ += batch.items.size();
  if (progress_) progress_({stage_, taken_, "objects"});
}

// Makes an object ready that make_ready has left as it was.
void ObjectFeed::learn_crs(city::CityObject&& object, Batch::Item& item) {
  std::map<std::string, std::vector<glm::dvec3>> samples;
  for_each_named(object, [&](const std::string& name, const city::Ring& ring) {
    std::vector<glm::dvec3>& sample = samples[name];
    sample.insert(sample.end(), ring.begin(), ring.end());
    if (!ring.empty()) sample.push_back(ring.front());
  });
  for (const auto& [name, sample] : samples)
    frames_.learn(name, sample, inputs_.files[file_].string() + ": " + object.id);
  item = prepare(make_ready(std::move(object), file_, settings_));
}

void ObjectFeed::take(Batch::Item&& item) {
  const city::CityObject& object = item.ready.prepared->object;
  ++report_.objects[city::name_of(object.type)];
  // A piece after one that was left out is not a further one.
  const bool continues = object.continues && object.id == last_id_;
  const char* left_out = find_reason(item.ready.unusable);
  item.version.file = static_cast<std::uint32_t>(file_);
  const char* repeat = left_out || continues ? nullptr : find_repeat(item);
  if (repeat) {
    last_id_.clear();
    left_out = repeat;
  } else {
    report_.mesh.merge(item.ready.report);
  }
  if (left_out) {
    ++report_.left_out[left_out];
    return;
  }
  if (item.ready.beyond_heights && !continues) ++report_.beyond_heights;
  if (!item.ready.elsewhere.empty() && !continues) ++elsewhere_[item.ready.elsewhere];
  for (const CityConsumer::Turn& turn : item.turns) turn(continues);
  if (!item.ready.prepared->mesh.triangles.empty()) last_id_ = object.id;
}

// Returns why an object is left out for another one; null: it is not. The pieces of a large object
// share its fate.
const char* ObjectFeed::find_repeat(const Batch::Item& item) {
  const city::CityObject& object = item.ready.prepared->object;
  if (object.continues && object.id == repeated_id_) return repeated_;
  repeated_ = versions_.take(item.version, object.joined_ids);
  repeated_id_ = repeated_ ? object.id : std::string();
  return repeated_;
}

}  // namespace nightcity::bake
