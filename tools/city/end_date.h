// Tells whether a city object stands there today: by dates at which objects begin and end, and by
// the marks of water that is none, but the flood of a plan.
#pragma once

#include <chrono>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity::city {

/// Returns why an object of this type is not there today by what one of its attributes says, as it
/// is counted; null where it says no such thing. `name`: local name in lower case. These are
/// * terminationDate and validTo, by which databases with a history say when an object was taken
///   out of the model, and dateOfDemolition (CityGML 3); yearOfDemolition is a plan as often as a
///   fact, and is not used;
/// * conditionOfConstruction (CityGML 3 and INSPIRE), a word or the address of one in a register:
///   demolished, projected, planned or declined (given up before it was built); a ruin and what is
///   under construction stand;
/// * validFrom;
/// * of water: class 1140 and attributes of a risk, by which Japan marks the water of a flood, a
///   tsunami or a broken dam that may come, and which would stand over the city.
const char* find_reason_to_leave_out(ObjectType type, std::string_view name, std::string_view value,
                                     std::chrono::sys_days today);

/// Returns whether the function above may have a reason for an attribute of this name: nearly all
/// are sorted out before their values are looked at.
bool may_say_when(ObjectType type, std::string_view name);

/// Returns whether a day or year ("2019", "2019-05-01", "2019-05-01T12:00:00Z") is
/// past on the day `today`; a year is past when it is over. False for other texts.
bool is_past(std::string_view date, std::chrono::sys_days today);

/// Returns whether such a day or year is still to come.
bool is_to_come(std::string_view date, std::chrono::sys_days today);

/// The names under which objects are counted that are left out for what they say.
constexpr const char* ended_object =
    "object: ended (its terminationDate, validTo or dateOfDemolition is past), or not built";
constexpr const char* future_object = "object: not there yet (its validFrom is to come)";
constexpr const char* flood_object =
    "object: water of a flood that may come (class 1140, or an attribute of its risk)";

}  // namespace nightcity::city
