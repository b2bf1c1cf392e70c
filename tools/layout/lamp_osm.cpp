#include "tools/layout/lamp_osm.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "formats/atomic_file.h"
#include "formats/colour.h"

namespace nightcity::layout {
namespace {

/// Returns the bearing clockwise from true north, which may differ from the frame's north.
double bearing_degrees(const glm::dvec2& from, const glm::dvec2& to) {
  const double east = (to.x - from.x) * std::cos(glm::radians(from.y)), north = to.y - from.y;
  const double degrees = glm::degrees(std::atan2(east, north));
  return degrees < 0 ? degrees + 360 : degrees;
}

/// Returns the hours as OSM writes them: "17:00-23:00;05:00-07:00".
std::string lit_hours(const lights::NightSchedule& hours) {
  std::string text;
  const auto clock = [](int minute) {
    return fmt::format("{:02}:{:02}", (lights::night_begin_hour + minute / 60) % 24, minute % 60);
  };
  for (std::size_t n = 0; n < hours.on.size(); ++n) {
    if (hours.on[n] >= hours.off[n]) continue;
    if (!text.empty()) text += ';';
    text += fmt::format("{}-{}", clock(hours.on[n]), clock(hours.off[n]));
  }
  return text;
}

/// Returns the colour temperature, or the colour itself where the lamp is no black body (sodium) or
/// its colour was tagged.
std::string colour_of(const lights::PlacedLamp& lamp) {
  const glm::vec3 black_body = rec709_from_xy(planckian_xy(lamp.cct_k));
  const bool alike = glm::distance(black_body, lamp.colour) < 1e-3F;
  return alike ? fmt::format("{:.0f} K", lamp.cct_k) : to_hex(lamp.colour);
}

}  // namespace

std::size_t write_lamp_osm(const std::filesystem::path& path,
                           std::span<const lights::PlacedLamp> lamps,
                           const std::function<glm::dvec2(const glm::dvec2&)>& to_lon_lat) {
  AtomicFile file(path);
  file.write(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\" "
      "generator=\"nightbake\">\n");
  std::size_t written = 0;
  std::string text;
  const auto tag = [&text](const char* key, const std::string& value) {
    text += fmt::format("<tag k=\"{}\" v=\"{}\"/>\n", key, value);
  };
  for (const lights::PlacedLamp& lamp : lamps) {
    const glm::dvec2 foot(lamp.foot), at = to_lon_lat(foot),
                                      ahead = to_lon_lat(foot + lamp.aim * 10.0);
    if (!std::isfinite(at.x + at.y + ahead.x + ahead.y)) continue;
    text = fmt::format("<node id=\"{}\" version=\"1\" lat=\"{:.7f}\" lon=\"{:.7f}\">\n",
                       -1 - std::int64_t{lamp.id}, at.y, at.x);
    tag("highway", "street_lamp");
    tag("height", fmt::format("{:g}", lamp.mounting_height_m));
    tag("light:luminous_flux", fmt::format("{:.0f}", lamp.flux_lm));
    tag("light:colour", colour_of(lamp));
    tag("light:direction", fmt::format("{:.0f}", bearing_degrees(at, ahead)));
    if (lamp.hung) tag("lamp_mount", "suspended");
    // A foot at exactly 0 means that no ground is known there.
    if (lamp.foot.z != 0) tag("ele", fmt::format("{:.2f}", lamp.foot.z));
    if (lamp.hours) tag("lit", lit_hours(*lamp.hours));
    const auto source = static_cast<std::int64_t>(lamp.provenance.source_id);
    const bool laid_out = lamp.provenance.flux == ValueSource::standard;  // see layout.h
    const bool in_inventory = lamp.provenance.position == ValueSource::inventory;
    tag("source", laid_out       ? fmt::format("nightbake layout along way {}", source)
                  : in_inventory ? fmt::format("inventory of lamps, row {}", source)
                                 : fmt::format("OpenStreetMap node {}", source));
    file.write(text + "</node>\n");
    ++written;
  }
  file.write("</osm>\n");
  file.commit();
  return written;
}

}  // namespace nightcity::layout
