// Decides whether schedules and traffic records are valid: one check for writers, readers and
// verify().
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "formats/night.h"

namespace nightcity {

// All functions return why the record is invalid, or nothing if it is valid.

/// Reads only those `switches` that the schedule refers to.
std::optional<std::string> schedule_fault(const Schedule& schedule, std::span<const uint> switches);

std::optional<std::string> cycle_fault(const TrafficCycle& cycle);
std::optional<std::string> vehicle_fault(const VehicleKind& vehicle, std::size_t light_count);

/// Checks what light_fault checks, and the light's family and condition.
std::optional<std::string> vehicle_light_fault(const Light& light, std::size_t profile_count);

/// Reads only those `knots` that the trip refers to.
std::optional<std::string> trip_fault(const Trip& trip, const TrafficCycle& cycle,
                                      std::size_t vehicle_count, std::span<const TripKnot> knots);

}  // namespace nightcity
