#include "tools/lights/windows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

#include "formats/colour.h"
#include "formats/rgb9e5.h"
#include "tools/in_order.h"

namespace nightcity::lights {
namespace {

constexpr double before_wall_m = 0.02;
constexpr double above_ground_m = 0.3;

/// Returns the number of a window's household. The windows of a household lie side by side on
/// one storey. A small house is one household, and so are a staircase over all of its storeys
/// and a lobby.
std::int64_t find_household(const WindowPlace& place, bool one_family, std::uint64_t building) {
  if (place.kind == WindowKind::stairs) return -2 - place.facade;
  if (place.kind == WindowKind::lobby) return -1;
  if (one_family) return 0;
  // Flats have two to four bays; the hash of a bay decides whether a new flat begins there.
  std::int64_t run = 0;
  for (int bay = 1, length = 1; bay <= place.bay; ++bay, ++length) {
    const std::uint64_t hash = mix(building ^ (static_cast<std::uint64_t>(place.facade) << 32 |
                                               static_cast<std::uint64_t>(bay)));
    if (length >= 4 || (length >= 2 && hash % 2 == 0)) ++run, length = 0;
  }
  return 1 + (static_cast<std::int64_t>(place.facade) << 40 |
              static_cast<std::int64_t>(place.storey) << 20 | run);
}

// The heights of the ground at places that were asked for: windows stand above each other.
class KnownGround {
 public:
  explicit KnownGround(const place::HeightAt& ground) : ground_(ground) {}
  std::optional<double> at(const glm::dvec2& place) {
    const auto [known, is_new] = known_.try_emplace(place);
    if (is_new) known->second = ground_(place);
    return known->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const glm::dvec2& p) const {
      return mix(std::bit_cast<std::uint64_t>(p.x) ^ mix(std::bit_cast<std::uint64_t>(p.y)));
    }
  };
  const place::HeightAt& ground_;
  std::unordered_map<glm::dvec2, std::optional<double>, Hash> known_;
};

}  // namespace

double LitRectangle::flux_lm() const {
  return std::numbers::pi * luminance_cd_m2 * 4.0 * half_width * half_height;
}

WindowLayout::WindowLayout(const WindowOptions& options, const std::filesystem::path& scratch)
    : options_(options), pending_(scratch), walls_(scratch) {}

WindowLayout::WindowBatch WindowLayout::make_batch(const city::CityObject& object,
                                                   std::uint64_t piece) const {
  WindowBatch batch;
  batch.walls = WallIndex::find_upright_walls(object);
  if (object.type != city::ObjectType::building) return batch;
  // An object without an id is identified by its place.
  std::uint64_t name = mix(hash_text(object.id) ^ piece);
  if (object.id.empty() && !object.polygons.empty() && !object.polygons.front().exterior.empty()) {
    const glm::dvec3& p = object.polygons.front().exterior.front();
    for (int axis = 0; axis < 3; ++axis)
      name = mix(name ^ static_cast<std::uint64_t>(std::llround(p[axis] * 100)));
  }
  const KnownUse use = use_of(object, options_.use_at);
  batch.use = std::string(name_of(use.use)) + (use.stated     ? ", stated"
                                               : use.from_map ? ", by the map"
                                                              : ", assumed");
  draw_lights(
      name, place_windows(object, use.use, options_.seed, batch.facades, options_.max_per_building),
      use.use, batch);
  return batch;
}

void WindowLayout::add(const city::CityObject& object, WindowBatch batch) {
  // A large object may come in several pieces with one id.
  piece_ = !object.id.empty() && object.id == last_id_ ? piece_ + 1 : 0;
  last_id_ = object.id;
  if (piece_ == 0)
    ++owners_;
  else
    batch = make_batch(object, piece_);
  walls_.add(batch.walls, owners_);
  if (!batch.use.empty()) ++report_.sources["use"][batch.use];
  if (batch.dark > 0) report_.left_out["dark all night"] += batch.dark;
  if (batch.facades.too_many > 0)
    report_.left_out["buildings with more than [windows] max_per_building"] +=
        batch.facades.too_many;
  facades_.storeys_from_attribute += batch.facades.storeys_from_attribute;
  facades_.storeys_from_height += batch.facades.storeys_from_height;
  for (Record& record : batch.windows) record.owner = owners_;
  pending_.write(batch.windows.data(), batch.windows.size() * sizeof(Record));
}

void WindowLayout::draw_lights(std::uint64_t name, const std::vector<WindowPlace>& places,
                               BuildingUse use, WindowBatch& batch) const {
  std::uint16_t top = 0;
  for (const WindowPlace& place : places) top = std::max(top, place.storey);
  const bool one_family = use == BuildingUse::residential && top < 2 && places.size() < 40;
  for (const WindowPlace& place : places) {
    const auto seed = static_cast<std::int64_t>(options_.seed),
               key = static_cast<std::int64_t>(name);
    const std::int64_t home = find_household(place, one_family, name);
    Random people{seed, key, home};
    const Household household =
        draw_household(use, people, Random{seed, key, -1 - place.storey, 2});
    const std::int64_t spot = static_cast<std::int64_t>(place.facade) << 32 |
                              static_cast<std::int64_t>(place.storey) << 16 | place.bay;
    const bool one_room = place.kind == WindowKind::stairs || place.kind == WindowKind::lobby ||
                          place.kind == WindowKind::shop;
    Random random{seed, key, one_room ? home : spot, one_room ? 3 : 1 + place.modelled};
    const LitWindow lit = draw_window(household, place.kind, random);
    if (lit.schedule.never()) {
      ++batch.dark;
      continue;
    }
    Record& record = batch.windows.emplace_back();
    LitRectangle& window = record.window;
    window.centre = place.centre + place.normal * before_wall_m;
    window.normal = glm::vec3(place.normal);
    window.along = glm::vec3(place.along);
    window.half_width = static_cast<float>(place.half_width);
    window.half_height = static_cast<float>(place.half_height);
    window.luminance_cd_m2 = static_cast<float>(lit.luminance_cd_m2);
    window.cct_k = static_cast<float>(lit.cct_k);
    window.hours = lit.schedule;
    window.id = static_cast<std::uint32_t>(mix(name ^ static_cast<std::uint64_t>(spot)));
    if (window.id == 0xFFFFFFFFu) window.id = 0;
    window.provenance.source_id = name;
    window.provenance.position = place.modelled ? ValueSource::attribute : ValueSource::rule;
    window.provenance.height = window.provenance.position;
    window.provenance.flux = window.provenance.colour = window.provenance.profile =
        ValueSource::rule;
    window.provenance.schedule = ValueSource::rule;
    window.provenance.family = static_cast<std::uint8_t>(LightFamily::window);
    record.use = use;
  }
}

/// Returns why the window cannot be where it is; null if it can.
const char* WindowLayout::fault(const Record& record, const place::HeightAt& ground,
                                const Inside& inside) {
  const LitRectangle& window = record.window;
  const glm::dvec3 normal(window.normal);
  const glm::dvec3 before = window.centre + normal * 0.3;
  const auto height = ground ? ground(glm::dvec2(before)) : std::nullopt;
  if (height &&
      window.centre.z - static_cast<double>(window.half_height) < *height + above_ground_m)
    return "below the ground";
  const glm::dvec3 along = glm::dvec3(window.along) * static_cast<double>(window.half_width);
  const glm::dvec3 up =
      glm::cross(normal, glm::dvec3(window.along)) * static_cast<double>(window.half_height);
  const glm::dvec3 on_wall = window.centre - normal * before_wall_m;
  std::array<glm::dvec3, 9> points;
  auto point = points.begin();
  for (const double x : {0.0, -0.95, 0.95})
    for (const double y : {0.0, -0.95, 0.95}) *point++ = on_wall + along * x + up * y;
  if (walls_.blocked(points, normal, options_.obstacle_m, record.owner))
    return "something before it";
  if (walls_.inside_another(on_wall, normal, record.owner) || (inside && inside(window.centre)))
    return "inside another building";
  return nullptr;
}

/// Returns the windows' numbers, those of one cell of the walls together: buildings that reach over
/// several cells would ask for each cell again and again.
std::vector<std::uint32_t> WindowLayout::order_by_cell(const std::vector<Record>& records) const {
  std::vector<std::pair<std::pair<std::int32_t, std::int32_t>, std::uint32_t>> keys;
  keys.reserve(records.size());
  for (const Record& record : records)
    keys.emplace_back(walls_.find_cell(record.window.centre),
                      static_cast<std::uint32_t>(keys.size()));
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& [cell, number] : keys) order.push_back(number);
  return order;
}

WindowReport WindowLayout::finish(const place::HeightAt& ground, const Sink& sink,
                                  const Inside& inside, unsigned threads) && {
  constexpr std::uint64_t block_size = 8192;
  struct CheckedWindows {
    std::vector<Record> records;
    std::vector<const char*> faults;
  };
  const std::uint64_t total = pending_.size() / sizeof(Record);
  std::uint64_t read = 0;
  const auto next = [&]() -> std::optional<std::vector<Record>> {
    if (read == total) return std::nullopt;
    std::vector<Record> block(static_cast<std::size_t>(std::min(block_size, total - read)));
    pending_.read(read * sizeof(Record), block.data(), block.size() * sizeof(Record));
    read += block.size();
    return block;
  };
  const auto check = [&](std::vector<Record>&& records) {
    CheckedWindows checked{std::move(records), {}};
    KnownGround known(ground);
    place::HeightAt height_at;
    if (ground) height_at = [&known](const glm::dvec2& place) { return known.at(place); };
    checked.faults.resize(checked.records.size());
    for (const std::uint32_t n : order_by_cell(checked.records))
      checked.faults[n] = fault(checked.records[n], height_at, inside);
    return checked;
  };
  const auto take = [&](CheckedWindows&& checked) {
    for (std::size_t i = 0; i < checked.records.size(); ++i) {
      if (checked.faults[i]) {
        ++report_.left_out[checked.faults[i]];
        continue;
      }
      const Record& record = checked.records[i];
      const bool modelled = record.window.provenance.position == ValueSource::attribute;
      ++report_.sources["position"][modelled ? "attribute" : "rule"];
      WindowReport::Use& use = report_.by_use[name_of(record.use)];
      ++use.placed;
      count_hours(record.window.hours, use.lit);
      ++report_.placed;
      ++report_.emitters;
      report_.flux_lm += record.window.flux_lm();
      sink(record.window);
    }
  };
  in_order(threads, next, check, take);
  report_.sources["storeys"]["attribute"] = facades_.storeys_from_attribute;
  report_.sources["storeys"]["rule"] = facades_.storeys_from_height;
  return std::move(report_);
}

Light to_light(const LitRectangle& window, const Georeference& georeference,
               ScheduleTable& schedules) {
  const auto turned = [](const glm::vec3& v) { return glm::normalize(glm::vec3(v.x, v.z, -v.y)); };
  Light light{};
  light.position = glm::vec3(georeference.to_model(window.centre));
  light.axis = turned(window.normal);
  light.tangent = turned(window.along);
  set_half_width(light, window.half_width);
  light.half_height = window.half_height;
  light.flux_lm = static_cast<float>(window.flux_lm());
  light.colour_rgb9e5 =
      encode_rgb9e5(rec709_from_xy(planckian_xy(static_cast<double>(window.cct_k))));
  light.kind_profile = pack_kind_profile(LightKind::rectangle, LIGHT_NO_PROFILE);
  light.schedule = schedules.add(window.hours);
  light.id = window.id;
  return light;
}

}  // namespace nightcity::lights
