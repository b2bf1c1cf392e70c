#include "tools/map_lights/map_light_defaults.h"

#include <algorithm>
#include <array>
#include <string>

#include "tools/osm/tag_values.h"

namespace nightcity::map_lights {
namespace {

// Sizes: billboards and screens have the poster of 18 sheets (3.56 m x 2.52 m) and poster boxes the
// one of 4 sheets (1.19 m x 1.75 m) of German outdoor advertising (sheets of DIN A1). Columns,
// signs, totems and boards vary; their sizes and all heights above the ground are assumptions.
//
// A screen shines by its nature. That poster boxes (back-lit ones are the rule in Germany), signs
// and totems do, unless a tag denies it, is an assumption; columns, billboards and boards shine
// only where a tag says so.
//
// Luminance: screens are dimmed to some 300 cd/m2 by night (signmedia.ca, "Illuminated signs:
// common issues in permitting LED displays"). 200 cd/m2 for back-lit faces is an assumption between
// that and the posters that are lit from outside. CIE 150:2017 allows signs 400 cd/m2 in zone E2
// (suburbs) and 800 in E3 (towns), so no default exceeds what a suburb may have.
constexpr std::array<SignDefaults, 7> signs = {{
    {"billboard", 3.56, 2.52, 1.0, 1, false, 200},
    {"column", 1.2, 2.6, 0.5, 0, false, 200},
    {"poster_box", 1.19, 1.75, 0.5, 2, true, 200},
    {"screen", 3.56, 2.52, 2.5, 1, true, 300},
    {"sign", 2.0, 0.6, 3.0, 1, true, 200},
    {"totem", 1.5, 4.0, 0.5, 2, true, 200},
    {"board", 1.2, 0.8, 1.0, 1, false, 200},
}};

// EN 12193:2018, class III (training and recreation), outdoors; where it has no row for a sport,
// that of football.
struct SportRow {
  const char* sport;
  double average_lx;
};
constexpr double football_lx = 75;
constexpr std::array<SportRow, 5> sports = {{
    {"soccer", football_lx},
    {"basketball", 75},
    {"athletics", 100},
    {"running", 100},
    {"tennis", 200},
}};

// lit_poster_cd_m2: posters lit from outside average less than 60 cd/m2 and rarely exceed 100 (C.
// B. Luginbuhl et al., Digital LED Billboard Luminance Recommendations, 2010). facade_lx: what
// Bega's table asks for sandstone (30 %) in dark surroundings; with the 35 % of our walls it gives
// 8.9 cd/m2, below the 10 cd/m2 that CIE 150:2017 allows facades in zone E3. canopy_lx,
// forecourt_lx: EN 12464-2:2014, fuel filling stations: service areas, and driveways in light
// surroundings. Colour temperatures are assumptions.

struct KindRow {
  const char* name;
  lights::NightSpan dark;
};
// Hours: nothing makes advertising end in most towns. Facades are dark from 23:00, as Bavaria's law
// on immissions (BayImSchG, article 9) asks of public buildings and CIE 150's curfew of all.
// Pitches close at 22:00, when the night's rest of Germany's ordinance on noise of sports grounds
// (18. BImSchV, section 2) begins. Petrol stations close from 22:00 to 6:00, which is an
// assumption.
constexpr int end_of_night = lights::night_minutes;
constexpr std::array<KindRow, map_light_kind_count> kinds = {{
    {"advertising", {0, 0}},
    {"floodlit", {lights::minute_of(23, 0), end_of_night}},
    {"pitch", {lights::minute_of(22, 0), end_of_night}},
    {"petrol_station", {lights::minute_of(22, 0), lights::minute_of(6, 0)}},
}};

}  // namespace

const char* name_of(MapLightKind kind) {
  return kinds[static_cast<std::size_t>(kind)].name;
}

std::optional<MapLightKind> find_kind(std::string_view name) {
  for (std::size_t n = 0; n < kinds.size(); ++n)
    if (kinds[n].name == name) return static_cast<MapLightKind>(n);
  return std::nullopt;
}

const SignDefaults* find_sign(std::string_view advertising) {
  for (const std::string_view part : osm::split_list(advertising)) {
    const std::string word = osm::normalise_tag(part);
    for (const SignDefaults& row : signs)
      if (row.advertising == word) return &row;
  }
  return nullptr;
}

double find_pitch_lx(std::string_view sport) {
  double most = 0;  // a pitch of several sports is lit for the one that needs most
  for (const std::string_view part : osm::split_list(sport)) {
    const std::string word = osm::normalise_tag(part);
    for (const SportRow& row : sports)
      if (row.sport == word) most = std::max(most, row.average_lx);
  }
  return most > 0 ? most : football_lx;
}

lights::NightSpan find_dark_span(MapLightKind kind) {
  return kinds[static_cast<std::size_t>(kind)].dark;
}

}  // namespace nightcity::map_lights
