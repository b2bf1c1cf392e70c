// Dates at which city objects end.
#pragma once

#include <chrono>
#include <string_view>

namespace nightcity::city {

/// Returns whether an attribute says when its object was taken out of the model, as databases with
/// a history export it, or on which day it was demolished (CityGML 3). (yearOfDemolition is a plan
/// as often as a fact, and is not used.) `name`: local name in lower case ("terminationdate").
bool is_end_date(std::string_view name);

/// Returns whether an attribute says in what condition a construction is (CityGML 3 and INSPIRE).
/// `name` as above.
bool is_condition(std::string_view name);

/// Returns whether such a condition means that nothing stands there: demolished, projected or
/// declined (given up before it was built). A ruin and what is under construction stand. The value
/// may be a word, or the address of one in a register.
bool is_nothing_built(std::string_view condition);

/// Returns whether a day or year of that kind ("2019", "2019-05-01", "2019-05-01T12:00:00Z") is
/// past on the day `today`; a year is past when it is over. False for other texts.
bool is_past(std::string_view date, std::chrono::sys_days today);

/// The name under which objects that have ended are counted.
constexpr const char* ended_object =
    "object: ended (its terminationDate, validTo or dateOfDemolition is past), or not built";

}  // namespace nightcity::city
