#include <algorithm>
#include <array>
#include <limits>

#include "tools/bake/recipe/tables.h"

namespace nightcity::recipe {
namespace {

std::array<float, 24> to_shares_by_hour(const Value& value) {
  std::array<float, 24> result{};
  const std::vector<Value> rows = value.elements(result.size(), "a list of 24 shares from noon on");
  for (std::size_t hour = 0; hour < result.size(); ++hour)
    result[hour] = static_cast<float>(rows[hour].number(0, 1));
  if (*std::max_element(result.begin(), result.end()) <= 0)
    value.refuse("leaves no hour with any traffic");
  return result;
}

}  // namespace

Table make_traffic_table(bake::Recipe::Traffic& traffic) {
  traffic::TrafficOptions& options = traffic.options;
  Key drives = flag_key("drives", traffic.is_made,
                        "`false` switches traffic off and keeps the table's other keys.");
  drives.default_value = "true";  // the table alone switches traffic on
  Key side = choice_key<traffic::Side>(
      "side", options.side, {{"left", traffic::Side::left}, {"right", traffic::Side::right}},
      "The side of the road that vehicles keep to. Without it: the country's.");
  return {"traffic",
          "Vehicles on the streets. A recipe without this table has none; an empty table is "
          "enough to have them.",
          {std::move(drives),
           number_key("vehicles", options.vehicles, {0, 1e6}, "vehicles", "300",
                      "Vehicles on the road at 22:00. Without it, `per_km` decides."),
           number_key("per_km", options.per_km, {0, 100}, "vehicles per km of lane", "2.0",
                      "Mean density at 22:00 over all streets. Without it, each class of road has "
                      "its own built-in density. `vehicles` overrides it."),
           number_key("cycle_s", options.cycle_s, {60, 86400}, "s",
                      "Time after which every vehicle repeats its trip."),
           integer_key("max_trips", options.max_trips, 1, 100'000'000,
                       "A limit: no more trips than this are planned for a cycle, nor more than "
                       "200 lanes and turns for each of them on average. How many vehicles that "
                       "leaves out is in the report. A vehicle takes some 100 kB of memory."),
           std::move(side),
           {"hours", "list of 24 numbers", "", "share of the busiest hour", "0 to 1 each",
            "[1, 1, 1, 1, 1, 1, 1, 1, 1, 0.84, 0.69, 0.45, 0.25, 0.16, 0.12, 0.12, 0.25, 0.84, 1, "
            "1, 1, 1, 1, 1]",
            "Traffic of each hour from noon on. Without it: the built-in curve of the example.",
            [&options](const Value& value) { options.hours = to_shares_by_hour(value); }},
           integer_key("seed", options.seed, 0, std::numeric_limits<int>::max(),
                       "Seed of the random draws of routes and vehicles.")},
          [&traffic] { traffic.is_made = true; }};
}

}  // namespace nightcity::recipe
