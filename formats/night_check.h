// What makes a schedule or a part of the traffic unfit for a file: one check for writers, readers and
// verify().
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "formats/night.h"

namespace nightcity {

/// Why a schedule may not stand in a file with these switch times; empty when it may. Reads the schedule's
/// own times.
std::optional<std::string> schedule_fault(const Schedule& schedule, std::span<const uint> switches);

std::optional<std::string> cycle_fault(const TrafficCycle& cycle);
std::optional<std::string> vehicle_fault(const VehicleKind& vehicle, std::size_t light_count);

/// A vehicle's light: as light_fault, and its family and condition.
std::optional<std::string> vehicle_light_fault(const Light& light, std::size_t profile_count);

/// Why a trip may not stand in a file; reads the trip's own knots.
std::optional<std::string> trip_fault(const Trip& trip, const TrafficCycle& cycle,
                                      std::size_t vehicle_count, std::span<const TripKnot> knots);

}  // namespace nightcity
