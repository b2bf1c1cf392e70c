#include "tools/bake/city/object_feed.h"

#include <utility>

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

}  // namespace

ObjectFeed::Batch::Item ObjectFeed::prepare(ReadyObject&& ready) const {
  Batch::Item item{std::move(ready), {}};
  if (item.ready.unknown || item.ready.unusable != Unusable::no) return item;
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
  const char* repeat = left_out || continues ? nullptr : find_repeat(item.ready);
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
  if (!item.ready.elsewhere.empty() && !continues) ++elsewhere_[item.ready.elsewhere];
  for (const CityConsumer::Turn& turn : item.turns) turn(continues);
  if (!item.ready.prepared->mesh.triangles.empty()) last_id_ = object.id;
}

// Neighbouring files may share objects, in other levels of detail, too. In one file two objects may
// have one id and a corner in common, and still be two.
const char* ObjectFeed::find_repeat(const ReadyObject& ready) {
  if (ready.identity == 0) return nullptr;
  const auto [found, is_new] = seen_.try_emplace(ready.identity, Seen{file_, ready.contents});
  if (is_new) return nullptr;
  if (found->second.file != file_) return "in two files";
  return found->second.contents == ready.contents ? "twice in one file" : nullptr;
}

}  // namespace nightcity::bake
