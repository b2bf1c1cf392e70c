#include "tools/city/merge_parts.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "tools/city/better_level.h"
#include "tools/city/end_date.h"
#include "tools/city/extrude.h"
#include "tools/city/ring.h"
#include "tools/city/text_encoding.h"

namespace nightcity::city {
namespace {

constexpr int unknown_lod = -1;

// Chooses of the LoDs that are present.
class LodChooser {
 public:
  explicit LodChooser(int limit) : limit_(limit) {}

  void add(int lod) {
    if (!chosen_ || is_better_level(lod, *chosen_, limit_)) chosen_ = lod;
  }
  std::optional<int> chosen() const { return chosen_; }

 private:
  int limit_;
  std::optional<int> chosen_;
};

struct LodChoice {
  std::vector<std::optional<int>> of_space;
  int of_object = unknown_lod;
};

// A building's level that holds nothing but its ground plate, or what fills its openings, shows no
// building.
bool shows_building(const Polygon& polygon) {
  return polygon.surface != SurfaceType::ground && polygon.surface != SurfaceType::closure &&
         polygon.surface != SurfaceType::window && polygon.surface != SurfaceType::door;
}

LodChoice choose_lods(const RawObject& raw, const ReadOptions& options) {
  std::vector<LodChooser> present(raw.spaces.size(), LodChooser(options.max_lod));
  LodChooser whole(options.max_lod);  // of spaces that can stand for the object alone
  const std::vector<RawPolygons::Place>& places = raw.polygons.places();
  const auto add = [&](std::size_t i) {
    if (places[i].lod == unknown_lod) return;
    present[places[i].space].add(places[i].lod);
    if (!raw.spaces[places[i].space].detail) whole.add(places[i].lod);
  };
  const auto differs = [&](const RawPolygons::Place& p) { return p.lod != places.front().lod; };
  const bool chooses =
      raw.object.type == ObjectType::building && std::any_of(places.begin(), places.end(), differs);
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (chooses && !shows_building(raw.polygons.polygons()[i]))
      others.push_back(i);
    else
      add(i);
  // They count where a space has nothing else.
  std::erase_if(others, [&](std::size_t i) { return present[places[i].space].chosen(); });
  for (const std::size_t i : others) add(i);
  LodChoice choice;
  const std::optional<int> best = whole.chosen();
  for (std::size_t i = 0; i < raw.spaces.size(); ++i) {
    std::optional<int> lod = present[i].chosen();
    // A detail of a higher LoD than the object is shown at would hang on walls that are not there.
    if (raw.spaces[i].detail && lod && best && *lod > std::max(*best, options.max_lod)) lod.reset();
    // A building whose parts have a better LoD: its own coarse block would stand inside or around
    // them.
    if (i == 0 && lod && best && *lod < *best) lod.reset();
    choice.of_space.push_back(lod);
  }
  choice.of_object = best.value_or(unknown_lod);
  return choice;
}

// The halves of the product of two numbers, folded into one (Wang Yi, wyhash, 2019).
std::uint64_t fold_product(std::uint64_t a, std::uint64_t b) {
  const auto product = static_cast<unsigned __int128>(a) * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

// A hash that is the same for rings of the same vertices, wherever they start and whichever way
// they run.
std::uint64_t vertex_set_hash(const Polygon& polygon) {
  constexpr std::uint64_t a = 0x9E3779B97F4A7C15, b = 0xA0761D6478BD642F, c = 0xE7037ED1A0B428DB;
  // + 0.0 makes -0 and 0 alike
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v + 0.0); };
  const auto of_ring = [&](const Ring& ring) {
    std::uint64_t sum = ring.size();
    for (const glm::dvec3& p : ring)
      sum += fold_product(fold_product(bits(p.x) ^ a, bits(p.y) ^ b) + bits(p.z), c);
    return sum;
  };
  std::uint64_t hash = of_ring(polygon.exterior);
  for (const Ring& ring : polygon.interiors) hash += fold_product(of_ring(ring), a);
  return hash;
}

bool vertex_less(const glm::dvec3& a, const glm::dvec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

bool same_vertices(const Polygon& a, const Polygon& b) {
  const auto same_ring = [](Ring r, Ring s) {
    std::sort(r.begin(), r.end(), vertex_less);
    std::sort(s.begin(), s.end(), vertex_less);
    return r == s;
  };
  return a.interiors.size() == b.interiors.size() && a.exterior.size() == b.exterior.size() &&
         same_ring(a.exterior, b.exterior);
}

// The polygons that were kept, to find those that repeat one of them.
class KeptPolygons {
 public:
  explicit KeptPolygons(const std::vector<Polygon>& raws) {
    hashes_.reserve(raws.size());
    for (const Polygon& raw : raws) hashes_.push_back(vertex_set_hash(raw));
    any_repeats_ = hashes_.size() <= max_compared ? any_pair_is_alike() : has_repeats(hashes_);
  }

  // Returns the index under which a polygon of the same hash was kept; keeps this one, the
  // `raw`th, under `index` where there is none. Most objects repeat nothing: they need no table.
  std::optional<std::size_t> find_or_keep(std::size_t raw, std::size_t index) {
    if (!any_repeats_) return {};
    const auto [at, fresh] = kept_.emplace(hashes_[raw], index);
    return fresh ? std::nullopt : std::optional(at->second);
  }

 private:
  static constexpr std::size_t max_compared = 16;  // so few are compared faster than looked up

  bool any_pair_is_alike() const {
    for (std::size_t i = 1; i < hashes_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (hashes_[i] == hashes_[k]) return true;
    return false;
  }
  static bool has_repeats(const std::vector<std::uint64_t>& hashes) {
    // Each goes to its place or the next free one; 0 stands for a free place.
    std::vector<std::uint64_t> table(std::bit_ceil(2 * hashes.size()));
    const std::size_t mask = table.size() - 1;
    std::size_t zeros = 0, steps = 0;
    for (const std::uint64_t hash : hashes) {
      std::size_t at = hash & mask;
      for (; table[at] != 0 && table[at] != hash; at = (at + 1) & mask) ++steps;
      if (steps > 4 * table.size()) return has_repeats_sorted(hashes);  // made to collide
      zeros += hash == 0;
      if (table[at] == hash && (hash != 0 || zeros > 1)) return true;
      table[at] = hash;
    }
    return false;
  }
  static bool has_repeats_sorted(std::vector<std::uint64_t> hashes) {
    std::sort(hashes.begin(), hashes.end());
    return std::adjacent_find(hashes.begin(), hashes.end()) != hashes.end();
  }

  std::vector<std::uint64_t> hashes_;
  bool any_repeats_ = false;
  std::unordered_map<std::uint64_t, std::size_t> kept_;
};

// Names come from strangers' files and go into others: JSON, OSM, reports.
void make_texts_valid(CityObject& object) {
  for (std::string* text : {&object.id, &object.class_name, &object.function, &object.usage,
                            &object.building_class, &object.address, &object.year})
    *text = to_valid_utf8(std::move(*text));
  if (object.plant) object.plant->species = to_valid_utf8(std::move(object.plant->species));
  for (Polygon& polygon : object.polygons)
    if (!polygon.id.empty()) polygon.id = to_valid_utf8(std::move(polygon.id));
}

void compare_heights(const CityObject& object, double height_unit_m, ReadReport& report) {
  constexpr double odd = 2.5;
  const double measured_m = object.measured_height_m.value_or(0);
  if (object.type != ObjectType::building || !(measured_m > 0) || object.polygons.empty()) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior)
      low = std::min(low, p.z), high = std::max(high, p.z);
  const double ratio = (high - low) * height_unit_m / measured_m;
  ++(ratio > odd       ? report.above_measured
     : ratio < 1 / odd ? report.below_measured
                       : report.as_measured);
}

}  // namespace

CityObject merge_parts(RawObject&& raw, const ReadOptions& options, ReadReport& report) {
  CityObject object = std::move(raw.object);
  const LodChoice choice = choose_lods(raw, options);
  object.lod = choice.of_object;
  if (!object.measured_height_m && raw.elevation_span)
    object.measured_height_m = *raw.elevation_span * options.height_unit_m;
  std::vector<Polygon>& polygons = raw.polygons.polygons();  // the first `count` are kept
  const std::vector<RawPolygons::Place>& places = raw.polygons.places();
  std::size_t count = 0;
  KeptPolygons kept_polygons(polygons);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const RawPolygons::Place& p = places[i];
    if (p.lod != unknown_lod && choice.of_space[p.space] != p.lod) {
      ++report.skipped["polygon: lod" + std::to_string(p.lod) + ", another LoD taken"];
      continue;
    }
    const auto alike = kept_polygons.find_or_keep(i, count);
    if (!alike || !same_vertices(polygons[*alike], polygons[i])) {
      if (count != i) polygons[count] = std::move(polygons[i]);
      ++count;
      continue;
    }
    ++report.skipped["polygon: repeats another of its object"];
    // The copy with a surface type wins: solids have none.
    Polygon& kept = polygons[*alike];
    if (kept.surface == SurfaceType::unknown && polygons[i].surface != SurfaceType::unknown)
      kept = std::move(polygons[i]);
  }
  polygons.resize(count);
  for (Polygon& polygon : polygons)
    if (!polygon.interiors.empty() && !polygon.picture && set_outer_ring(polygon))
      ++report.assumed["outline of a polygon: the file has it as a hole"];
  if (polygons.capacity() > count + count / 4) polygons.shrink_to_fit();
  object.polygons = std::move(polygons);
  if (!object.continues) {
    ++report.objects;
    if (object.type == ObjectType::building && !object.storeys_above_ground)
      object.storeys_above_ground = raw.named_heights.storeys();
    const bool lod0_alone = std::all_of(places.begin(), places.end(),
                                        [](const RawPolygons::Place& p) { return p.lod == 0; });
    if (lod0_alone && object.type == ObjectType::building && !find_block_height_m(object))
      object.measured_height_m = raw.named_heights.find_height_m(options.height_unit_m);
    if (!lod0_alone) compare_heights(object, options.height_unit_m, report);
    if (lod0_alone && is_flat_building(object))
      ++(extrude_flat_building(object, options.height_unit_m) ? report.extruded : report.flat);
  }
  make_texts_valid(object);
  report.polygons += object.polygons.size();
  return object;
}

void count_left_out(const RawObject& raw, SkipCounter& skipped) {
  skipped.add(raw.left_out);
  if (raw.polygons.empty()) return;
  skipped.add(raw.left_out == ended_object ? "polygon: of an object that ended"
                                           : "polygon: of an object that is not there",
              raw.polygons.size());
}

}  // namespace nightcity::city
