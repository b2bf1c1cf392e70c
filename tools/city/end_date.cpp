#include "tools/city/end_date.h"

#include <charconv>
#include <string>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

namespace nightcity::city {

bool is_end_date(std::string_view name) {
  return name == "terminationdate" || name == "validto" || name == "dateofdemolition";
}

bool is_condition(std::string_view name) {
  return name == "conditionofconstruction";
}

bool is_nothing_built(std::string_view condition) {
  condition = trim(condition);
  const std::string word = to_lower(condition.substr(condition.find_last_of("/:#") + 1));
  return word == "demolished" || word == "projected" || word == "planned" || word == "declined";
}

bool is_past(std::string_view date, std::chrono::sys_days today) {
  using namespace std::chrono;
  date = trim(date);
  const auto take = [&](std::size_t digits) {
    unsigned value = 0;
    const bool whole = date.size() >= digits;
    const char* const end = date.data() + (whole ? digits : 0);
    const auto [stop, error] = std::from_chars(date.data(), end, value);
    const bool read = whole && error == std::errc() && stop == end;
    if (read) date.remove_prefix(digits);
    return read ? value : 0;
  };
  const unsigned number = take(4);
  if (number == 0) return false;
  const year_month_day now(today);
  const auto in_year = year(static_cast<int>(number));
  if (date.empty() || date == "Z" || date.starts_with('+')) return in_year < now.year();
  if (!date.starts_with('-')) return false;
  date.remove_prefix(1);
  const unsigned month_number = take(2);
  if (!date.starts_with('-')) return in_year < now.year();  // a year with a time zone, or a month
  date.remove_prefix(1);
  const auto day_of = in_year / month(month_number) / day(take(2));
  return day_of.ok() && sys_days(day_of) < today;
}

}  // namespace nightcity::city
