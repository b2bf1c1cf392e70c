#include "tools/bake/report/traffic_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {
namespace {

using nlohmann::json;

const char* name_of(traffic::Side side) {
  return side == traffic::Side::left ? "left" : "right";
}

double overlap_share(const traffic::TrafficReport& report) {
  return report.overlap_samples
             ? static_cast<double>(report.overlapping) / static_cast<double>(report.overlap_samples)
             : 0;
}

}  // namespace

json to_json(const traffic::TrafficReport& report) {
  json classes = json::object(), seconds = json::object();
  for (const auto& [highway, km] : report.plans.lane_km)
    classes[highway] = {{"lane_km", km},
                        {"vehicles_wanted", report.plans.wanted.at(highway)},
                        {"vehicles_given", report.plans.given.at(highway)}};
  for (const auto& [step, value] : report.seconds) seconds[step] = value;
  return {{"country", report.country},
          {"side", name_of(report.side)},
          {"ways_left_out", report.left_out},
          {"nodes", report.nodes},
          {"edges", report.edges},
          {"links", report.links},
          {"classes", classes},
          {"cycle_s", report.cycle_s},
          {"trips", report.trips},
          {"trips_by_vehicle", report.by_type},
          {"knots", report.knots},
          {"driven_km", report.driven_km},
          {"mean_speed_m_s", report.mean_speed_m_s},
          {"vehicles_on_the_road", report.mean_vehicles},
          {"vehicles_by_hour_from_noon", report.vehicles_by_hour},
          {"brakings", report.brakings},
          {"knot_error",
           {{"m", report.knot_error.position_m}, {"degrees", report.knot_error.heading_degrees}}},
          {"vehicles_beyond_max_trips", report.plans.beyond_limit},
          {"too_long_for_the_cycle_km", report.plans.too_long_km},
          {"rejected_routes", report.plans.left_out},
          {"routes_through_buildings", report.plans.through_buildings},
          {"links_km", report.links_km},
          {"links_in_buildings_km", report.links_in_buildings_km},
          {"max_at_once", report.simulation.max_at_once},
          {"never_started", report.simulation.never_started},
          {"stuck", report.simulation.stuck},
          {"waited_at_start_s", report.simulation.waited_s},
          {"overlaps",
           {{"share_of_vehicle_moments", overlap_share(report)},
            {"trips_left_out", report.overlaps_left_out}}},
          {"seconds", seconds}};
}

std::string to_text(const traffic::TrafficReport& report) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<12}{}\n", name, value);
  };
  line(
      "traffic",
      fmt::format(
          "{} trips in a cycle of {:.0f} s, {:.1f} km, {:.0f} vehicles at once in the busiest hour",
          report.trips, report.cycle_s, report.driven_km, report.mean_vehicles));
  if (report.plans.too_long_km > 0)
    line("",
         fmt::format("{:.1f} km of roads carry no trip, because driving through takes longer "
                     "than the cycle allows: [traffic] cycle_s = {:.0f} would do",
                     report.plans.too_long_km, 10 * std::ceil(report.plans.needed_cycle_s / 10)));
  if (report.edges == 0) return text;
  line("", fmt::format("{}, on the {}; {} lanes and turns; {}", report.country,
                       name_of(report.side), report.links, in_words(report.by_type)));
  std::string hours;
  for (const std::size_t hour : {5u, 6u, 8u, 10u, 11u, 12u, 15u, 18u})
    hours += fmt::format("{}{:02}h {:.0f}", hours.empty() ? "" : ", ", (hour + 12) % 24,
                         report.vehicles_by_hour[hour]);
  line("", "on the road at " + hours);
  line("", fmt::format(
               "{} brakings, mean speed {:.1f} km/h; {} knots, within {:.3f} m and {:.2f} degrees",
               report.brakings, report.mean_speed_m_s * 3.6, report.knots,
               report.knot_error.position_m, report.knot_error.heading_degrees));
  line("", fmt::format("{:.4f} % of vehicles overlapped another: {} trips left out for it; {} "
                       "stuck, {} not started",
                       100 * overlap_share(report), report.overlaps_left_out,
                       report.simulation.stuck, report.simulation.never_started));
  if (report.plans.beyond_limit > 0)
    line("", fmt::format("{} vehicles left out: [traffic] max_trips is reached",
                         report.plans.beyond_limit));
  if (report.links_in_buildings_km > 0)
    line("",
         fmt::format("{:.2f} of {:.1f} km of lanes and turns touch a building: no trip uses them",
                     report.links_in_buildings_km, report.links_km));
  line("", "ways left out: " + in_words(report.left_out));
  return text;
}

}  // namespace nightcity::bake
