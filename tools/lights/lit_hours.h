// The hours of light that a text of OpenStreetMap gives.
#pragma once

#include <optional>
#include <string_view>

#include "tools/lights/night_schedule.h"

namespace nightcity::lights {

/// Returns the night that a value of `lit` or `opening_hours` means ("sunset-23:00", "24/7",
/// "16:00-00:30;05:00-sunrise", "6pm-11pm", "17:00+", "22:00-06:00 off"). Of hours that differ by
/// the day or the season ("Mo-Fr 17:00-22:00; Sa,Su 17:00-24:00", "Oct-Mar 17:00-22:00") those of a
/// Wednesday of December, in the south of June, and the morning behind it hold, as traffic is that
/// of a weekday and the sun sets before our night and rises after it; holidays do not count. The
/// night is never() where the text gives hours, but none in it. Empty if the text gives no hours
/// ("yes", "automatic"), or cannot be read.
std::optional<NightSchedule> parse_lit_hours(std::string_view text, Half half = Half::north);

}  // namespace nightcity::lights
