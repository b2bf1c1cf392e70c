#include "tools/ground_cover/tracks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// Gauges: OSM wiki, "Key:gauge": 1435 mm unless said otherwise; 1000 mm is the commonest narrow
// gauge (an assumption for a single railway). Spacing: EBO, section 10: 4.00 m on open lines. Trams
// are at most 2.65 m wide (BOStrab, section 34); 0.35 m between two of them is an assumption.
constexpr double standard_m = 1.435, metre_gauge_m = 1.000, line_spacing_m = 4.00,
                 tram_spacing_m = 3.00;
constexpr std::array kinds{
    TrackKind{"rail", standard_m, line_spacing_m, false},
    TrackKind{"light_rail", standard_m, tram_spacing_m, true},
    TrackKind{"subway", standard_m, line_spacing_m, false},
    TrackKind{"tram", standard_m, tram_spacing_m, true},
    TrackKind{"narrow_gauge", metre_gauge_m, line_spacing_m, true},
    TrackKind{"preserved", standard_m, line_spacing_m, false},
    TrackKind{"funicular", metre_gauge_m, line_spacing_m, true},
    // OSM wiki, "Key:railway": these have other rails, are toys, or carry no trains (yet).
    TrackKind{"monorail", 0, 0, false},
    TrackKind{"miniature", 0, 0, false},
    TrackKind{"disused", 0, 0, false},
    TrackKind{"abandoned", 0, 0, false},
    TrackKind{"razed", 0, 0, false},
    TrackKind{"dismantled", 0, 0, false},
    TrackKind{"demolished", 0, 0, false},
    TrackKind{"construction", 0, 0, false},
    TrackKind{"proposed", 0, 0, false},
    TrackKind{"planned", 0, 0, false},
};

// A sleeper of type B 70 (DB) is 2.60 m long under rails of 1.435 m. The ballast reaches 0.40 m
// beyond it, then slopes at 1 : 1.5 down the 0.50 m of a sleeper and what it lies on: usual
// practice, and assumptions for a single railway.
constexpr double beside_gauge_m = 2.60 - standard_m + 2 * 0.40, slopes_m = 2 * 1.5 * 0.50;
// Beside a pavement people walk up to where vehicles are: they are at most 2.65 m wide (BOStrab,
// section 34).
constexpr double vehicle_beside_gauge_m = 2.65 - standard_m;

// From the narrowest gauge of a railway that carries people, with a margin, to the widest ever
// (Great Western Railway, 2140 mm).
constexpr double min_gauge_mm = 300, max_gauge_mm = 2200;
constexpr std::size_t max_gauges = 3;
constexpr int max_tracks = 8;

// Returns the first number of a tag; 0 where there is none.
double number_at(const osm::OsmTags& tags, const char* key) {
  std::string_view text = osm::find_raw_tag(tags, key);
  return osm::take_number(text).value_or(0);
}

std::vector<double> read_gauges_m(std::string_view text) {
  std::vector<double> gauges_m;
  for (std::string_view part : osm::split_list(text)) {
    if (osm::normalise_tag(part) == "standard") part = "1435";
    const auto mm = osm::take_number(part);
    const std::string unit = osm::normalise_tag(part);
    if (mm && *mm >= min_gauge_mm && *mm <= max_gauge_mm && (unit.empty() || unit == "mm"))
      gauges_m.push_back(*mm / 1000);
  }
  std::sort(gauges_m.begin(), gauges_m.end());
  gauges_m.erase(std::unique(gauges_m.begin(), gauges_m.end()), gauges_m.end());
  if (gauges_m.size() > max_gauges) gauges_m.clear();
  return gauges_m;
}

bool is_grass_track(const osm::OsmTags& tags) {
  return osm::find_tag(tags, "railway:track") == "grass" ||
         osm::is_tagged(tags, "railway:track:grass");
}

bool is_embedded(const osm::OsmTags& tags) {
  return osm::is_tagged(tags, "embedded") || osm::is_tagged(tags, "embedded_rails");
}

std::optional<TrackBed> read_bed(const osm::OsmTags& tags) {
  if (is_embedded(tags)) return std::nullopt;
  if (is_grass_track(tags)) return TrackBed{GroundKind::grass};
  // Gravel under a track is ballast.
  if (const auto kind = find_surface(osm::find_raw_tag(tags, "surface")))
    return TrackBed{*kind == GroundKind::gravel ? GroundKind::ballast : *kind};
  return TrackBed{GroundKind::ballast, true};
}

}  // namespace

const TrackKind* find_track_kind(std::string_view railway) {
  for (const TrackKind& kind : kinds)
    if (kind.railway == railway) return &kind;
  return nullptr;
}

double TrackBed::width_m(double gauge_m) const {
  return gauge_m + beside_gauge_m + (kind == GroundKind::ballast ? slopes_m : 0);
}

double TrackBed::paved_width_m(double gauge_m) {
  return gauge_m + vehicle_beside_gauge_m;
}

double Tracks::middle_m(int track) const {
  return (track - (count - 1) / 2.0) * kind->spacing_m;
}

std::vector<double> Tracks::find_rails() const {
  const double right_m = -gauges_m.back() / 2;  // the inner face of the rail that all share
  std::vector<double> rails{right_m - rail_head_m};
  for (const double gauge_m : gauges_m) rails.push_back(right_m + gauge_m);
  return rails;
}

std::string find_reason_to_leave_out(const osm::OsmTags& tags, const TrackKind& kind) {
  if (!(kind.gauge_m > 0)) return "railway=" + std::string(kind.railway);
  const std::string tunnel = osm::find_tag(tags, "tunnel");
  const bool tunnelled = osm::is_tagged(tags, "tunnel") && tunnel != "building_passage",
             covered = osm::is_tagged(tags, "covered") || kind.railway == "subway";
  if (tunnelled || osm::find_tag(tags, "indoor") == "yes" ||
      osm::find_tag(tags, "location") == "underground" || number_at(tags, "level") < 0 ||
      (covered && number_at(tags, "layer") < 0))
    return "tracks below ground";
  return {};
}

Tracks read_tracks(const osm::OsmTags& tags, const TrackKind& kind) {
  Tracks tracks;
  tracks.kind = &kind;
  tracks.gauges_m = read_gauges_m(osm::find_raw_tag(tags, "gauge"));
  if (tracks.gauges_m.empty()) {
    tracks.gauges_m = {kind.gauge_m};
    (osm::find_raw_tag(tags, "gauge").empty() ? tracks.gauge_assumed : tracks.gauge_refused) = true;
  }
  const double count = number_at(tags, "tracks");
  if (count >= 1 && count <= max_tracks) tracks.count = static_cast<int>(count);
  tracks.bed = read_bed(tags);
  tracks.elevated = osm::is_tagged(tags, "bridge") || number_at(tags, "layer") > 0 ||
                    number_at(tags, "level") > 0;
  return tracks;
}

}  // namespace nightcity::ground_cover
