#include "tools/city/end_date.h"

#include <charconv>
#include <optional>
#include <string>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

namespace nightcity::city {
namespace {

struct Days {
  std::chrono::sys_days first, last;
};

// Returns the days of a date: of a year (also of one of its months), or one.
std::optional<Days> read_days(std::string_view date) {
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
  if (number == 0) return {};
  const auto in_year = year(static_cast<int>(number));
  const Days whole_year{sys_days(in_year / January / 1), sys_days(in_year / December / 31)};
  if (date.empty() || date == "Z" || date.starts_with('+')) return whole_year;
  if (!date.starts_with('-')) return {};
  date.remove_prefix(1);
  const unsigned month_number = take(2);
  if (!date.starts_with('-')) return whole_year;  // a year with a time zone, or a month
  date.remove_prefix(1);
  const auto day_of = in_year / month(month_number) / day(take(2));
  if (!day_of.ok()) return {};
  return Days{sys_days(day_of), sys_days(day_of)};
}

bool is_end(std::string_view name) {
  return name == "terminationdate" || name == "validto" || name == "dateofdemolition";
}

bool is_nothing_built(std::string_view condition) {
  condition = trim(condition);
  const std::string word = to_lower(condition.substr(condition.find_last_of("/:#") + 1));
  return word == "demolished" || word == "projected" || word == "planned" || word == "declined";
}

}  // namespace

bool is_past(std::string_view date, std::chrono::sys_days today) {
  const auto days = read_days(date);
  return days && days->last < today;
}

bool is_to_come(std::string_view date, std::chrono::sys_days today) {
  const auto days = read_days(date);
  return days && days->first > today;
}

bool may_say_when(ObjectType type, std::string_view name) {
  const bool is_of_flood = name == "class" || name.ends_with("riskattribute");
  return is_end(name) || name == "conditionofconstruction" || name == "validfrom" ||
         (type == ObjectType::water && is_of_flood);
}

const char* find_reason_to_leave_out(ObjectType type, std::string_view name, std::string_view value,
                                     std::chrono::sys_days today) {
  if (!may_say_when(type, name)) return nullptr;
  if (is_end(name)) return is_past(value, today) ? ended_object : nullptr;
  if (name == "conditionofconstruction") return is_nothing_built(value) ? ended_object : nullptr;
  if (name == "validfrom") return is_to_come(value, today) ? future_object : nullptr;
  return name != "class" || trim(value) == "1140" ? flood_object : nullptr;
}

}  // namespace nightcity::city
