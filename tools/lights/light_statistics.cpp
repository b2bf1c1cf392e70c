#include "tools/lights/light_statistics.h"

#include <algorithm>
#include <optional>

#include "formats/light_check.h"
#include "formats/night_check.h"
#include "formats/schedule.h"

namespace nightcity::lights {
namespace {

void count_hours(const Light& light, const LightFile& file, FamilyStatistics& family) {
  if (light.schedule == LIGHT_ALWAYS_ON) {
    ++family.always_on;
    for (std::size_t& lit : family.lit) ++lit;
    return;
  }
  const Schedule& schedule = file.schedules()[light.schedule];
  for (std::size_t hour = 0; hour < night_hours; ++hour) {
    // The night ends at 07:00, so its last hour counts what was lit a minute earlier.
    const uint second =
        night_begin_s + static_cast<uint>(hour) * 3600 - (hour + 1 == night_hours ? 60 : 0);
    family.lit[hour] += is_lit(schedule, file.switches(), second);
  }
}

std::optional<std::string> fault_of(const Light& light, const LightFile& file) {
  if (auto fault = light_fault(light, file.profiles().size())) return fault;
  if (light.schedule == LIGHT_ALWAYS_ON) return std::nullopt;
  if (light.schedule >= file.schedules().size()) return "schedule is not there";
  return schedule_fault(file.schedules()[light.schedule], file.switches());
}

}  // namespace

LightStatistics count_lights(const LightFile& file, const PlaceFault& place_fault) {
  LightStatistics statistics;
  for (std::size_t i = 0; i < file.lights().size(); ++i) {
    const Light& light = file.lights()[i];
    if (const auto fault = fault_of(light, file)) {
      ++statistics.faults[*fault];
      continue;
    }
    if (place_fault)
      if (const std::string fault = place_fault(light); !fault.empty()) ++statistics.faults[fault];
    const LightProvenance& from = file.provenance()[i];
    FamilyStatistics& family = statistics.families[name_of(static_cast<LightFamily>(from.family))];
    ++family.count;
    family.flux_lm += double{light.flux_lm};
    ++family.kinds[name_of(light_kind(light))];
    count_hours(light, file, family);
    const std::pair<const char*, ValueSource> values[] = {
        {"position", from.position}, {"height", from.height},   {"flux", from.flux},
        {"colour", from.colour},     {"profile", from.profile}, {"hours", from.schedule}};
    for (const auto& [value, source] : values) ++family.sources[value][name_of(source)];
  }
  return statistics;
}

}  // namespace nightcity::lights
