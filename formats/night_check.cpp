#include "formats/night_check.h"

#include <cmath>

#include "formats/finite.h"
#include "formats/light_check.h"
#include "formats/schedule.h"

namespace nightcity {
namespace {

bool lies_in(std::size_t first, std::size_t count, std::size_t size) {
  return first <= size && count <= size - first;
}

}  // namespace

std::optional<std::string> schedule_fault(const Schedule& schedule,
                                          std::span<const uint> switches) {
  if (!lies_in(schedule.first, schedule.count, switches.size()))
    return "switch times lie outside their section";
  const auto times = switches.subspan(schedule.first, schedule.count);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] >= day_s) return "switch time is not within a day";
    if (i > 0 && times[i] <= times[i - 1]) return "switch times do not ascend";
  }
  return std::nullopt;
}

std::optional<std::string> cycle_fault(const TrafficCycle& cycle) {
  if (!(cycle.cycle_s > 0 && cycle.cycle_s <= day_s)) return "cycle is not within a day";
  for (const float share : cycle.density)
    if (!(share >= 0 && share <= 1)) return "density is not a share";
  return std::nullopt;
}

std::optional<std::string> vehicle_fault(const VehicleKind& vehicle, std::size_t light_count) {
  const glm::vec3 size = vehicle.half_size;
  if (!is_within_reach(size) || !(size.x > 0 && size.y > 0 && size.z > 0))
    return "has no size or one beyond 1e15 m";
  if (vehicle.light_count > VEHICLE_LIGHTS) return "carries too many lights";
  if (!lies_in(vehicle.first_light, vehicle.light_count, light_count))
    return "lights lie outside their section";
  return std::nullopt;
}

std::optional<std::string> vehicle_light_fault(const Light& light, std::size_t profile_count) {
  if (auto fault = light_fault(light, profile_count)) return fault;
  if (light.schedule > VEHICLE_LIGHT_BRAKING)
    return "unknown condition " + std::to_string(light.schedule);
  if (light.id > 255) return "unknown family " + std::to_string(light.id);
  return std::nullopt;
}

std::optional<std::string> trip_fault(const Trip& trip, const TrafficCycle& cycle,
                                      std::size_t vehicle_count, std::span<const TripKnot> knots) {
  if (trip.vehicle >= vehicle_count) return "unknown vehicle " + std::to_string(trip.vehicle);
  if (!(trip.start_s >= 0 && trip.start_s < cycle.cycle_s)) return "start is not within the cycle";
  if (!(trip.rank >= 0 && trip.rank < 1)) return "rank is not in [0, 1)";
  if (trip.knot_count < 2) return "has fewer than two knots";
  if (!lies_in(trip.first_knot, trip.knot_count, knots.size()))
    return "knots lie outside their section";
  const auto way = knots.subspan(trip.first_knot, trip.knot_count);
  if (way.front().time_s != 0) return "first knot is not at time 0";
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (!finite(way[i].position) || !finite(way[i].velocity))
      return "knot " + std::to_string(i) + " is not finite";
    if (!is_within_reach(way[i].position))
      return "knot " + std::to_string(i) + " lies beyond 1e15 m";
    if (!(way[i].time_s <= cycle.cycle_s))
      return "knot " + std::to_string(i) + " is later than the cycle";
    if (i > 0 && !(way[i].time_s > way[i - 1].time_s)) return "knot times do not ascend";
  }
  return std::nullopt;
}

}  // namespace nightcity
