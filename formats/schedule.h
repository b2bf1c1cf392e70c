// When a light of a schedule is lit: the one meaning of the schedule records of night.h. Shared by
// what writes them, by what counts them and by the renderer.
#pragma once

#include <cstdint>
#include <span>

#include "formats/night.h"

namespace nightcity {

/// Returns whether a light with this schedule is lit `time_s` seconds after noon. Times outside a
/// day wrap round. `switches` holds the switch times of the whole light file.
bool is_lit(const Schedule& schedule, std::span<const std::uint32_t> switches, double time_s);

}  // namespace nightcity
