#include "tools/lights/occupancy.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nightcity::lights {
namespace {

/// Collects spans of light and sorts them.
class Times {
 public:
  void add(double on, double off) {
    const int first = rounded(std::clamp(on, 0.0, static_cast<double>(night_minutes)));
    const int last = rounded(std::clamp(off, 0.0, static_cast<double>(night_minutes)));
    if (first < last) times_.emplace_back(first, last);
  }

  NightSchedule schedule() {
    std::sort(times_.begin(), times_.end());
    NightSchedule result;
    std::size_t used = 0;
    for (const auto& [on, off] : times_) {
      if (used > 0 && on <= result.off[used - 1]) {
        result.off[used - 1] = std::max(result.off[used - 1], static_cast<std::uint16_t>(off));
      } else if (used < 4) {
        result.on[used] = static_cast<std::uint16_t>(on);
        result.off[used++] = static_cast<std::uint16_t>(off);
      }
    }
    return result;
  }

 private:
  static int rounded(double minute) { return 5 * static_cast<int>(std::lround(minute / 5)); }
  std::vector<std::pair<int, int>> times_;
};

double around(Random& random, int middle, double deviation) {
  return middle + deviation * random.normal();
}

enum class Room { living, kitchen, bedroom, bath };

Room draw_room(Random& random) {
  const double pick = random.uniform();
  return pick < 0.38   ? Room::living
         : pick < 0.60 ? Room::kitchen
         : pick < 0.88 ? Room::bedroom
                       : Room::bath;
}

// The draws are separate statements, because the order of evaluation of arguments is unspecified.
void dwelling(const Household& home, Random& random, Times& times) {
  if (!home.present) return;
  const double from = home.from, to = home.to, awake = to - from;
  switch (draw_room(random)) {
    case Room::living:
      if (random.chance(0.92)) {
        const double off = to - random.range(0, 20), on = from + random.range(0, 40);
        times.add(on, off);
      }
      break;
    case Room::kitchen:
      if (random.chance(0.85)) times.add(from, from + random.range(100, 260));
      if (random.chance(0.35)) {
        const double off = to - random.range(10, 50), on = to - random.range(60, 120);
        times.add(on, off);
      }
      break;
    case Room::bedroom:
      if (random.chance(0.55)) {
        const double off = from + awake * random.range(0.45, 0.9),
                     on = from + awake * random.range(0.0, 0.4);
        times.add(on, off);
      }
      {
        const double off = to + random.range(0, 25), on = to - random.range(15, 70);
        times.add(on, off);
      }
      break;
    case Room::bath:
      for (int n = 0; n < 2; ++n) {
        const double at = from + awake * random.uniform();
        times.add(at, at + random.range(10, 30));
      }
      times.add(to - 25, to - 5);
      break;
  }
  if (random.chance(0.85)) {
    const double off = home.morning + random.range(30, 80), on = home.morning + random.range(0, 15);
    times.add(on, off);
  }
  if (home.all_night && random.chance(0.6)) times.add(from, night_minutes);
}

void workplace(const Household& floor, Random& random, Times& times) {
  if (floor.present) {
    // A group mostly leaves together; the others stay longer or leave earlier.
    const double leave = random.chance(0.6) ? floor.to : -120 * std::log(1 - random.uniform());
    times.add(0, leave);
  }
  if (floor.cleaned >= 0) times.add(floor.cleaned, floor.cleaned + random.range(10, 25));
  if (floor.all_night && random.chance(0.7)) times.add(0, night_minutes);
  if (random.chance(0.25))
    times.add(random.range(minute_of(6, 10), minute_of(6, 55)), night_minutes);
}

}  // namespace

// Shares aimed at (engineering values; the shape is that of Berlin's windows by Meier,
// lightingjournal.org 82, and of Nachtlichter, Nature Cities 2025: private light fades round
// midnight, infrastructure stays): dwellings 45 % lit at 18 h, 55 % at 20 h, 40 % at 22 h, 25 % at
// 23 h, 12 % at 0 h, 3 % at 3 h, 25 % at 6 h; offices 65, 30, 12 % at 18, 20, 22 h and 6 % at 0 h;
// shop windows and lobbies half of them all night; staircases 30 %.
Household draw_household(BuildingUse use, Random& random, Random storey) {
  Household home{use, true, 0, 0, night_minutes, false, -1};
  switch (use) {
    case BuildingUse::office:
    case BuildingUse::education:
    case BuildingUse::civic:
      home.present = random.chance(use == BuildingUse::office ? 0.95 : 0.55);
      home.to = static_cast<int>(-145 * std::log(1 - random.uniform()));
      home.all_night = random.chance(0.06);
      // Three storeys in ten are cleaned tonight, all their rooms within an hour and a half.
      if (storey.chance(0.3))
        home.cleaned = static_cast<int>(storey.range(minute_of(19, 15), minute_of(20, 15)) +
                                        random.range(0, 90));
      break;
    case BuildingUse::retail:
      home.to = static_cast<int>(around(random, minute_of(20, 0), 45));
      home.all_night = random.chance(0.5);
      break;
    case BuildingUse::industrial:
      home.present = random.chance(0.7);
      home.to = static_cast<int>(around(random, minute_of(21, 0), 80));
      home.all_night = random.chance(0.3);
      break;
    default:
      home.present = random.chance(use == BuildingUse::hotel ? 0.65 : 0.9);
      home.from = static_cast<int>(around(random, minute_of(17, 0), 65));
      home.to = std::max(home.from + 30, static_cast<int>(around(random, minute_of(22, 55), 65)));
      home.morning = static_cast<int>(around(random, minute_of(5, 55), 50));
      home.all_night = random.chance(0.045);
      break;
  }
  return home;
}

LitWindow draw_window(const Household& household, WindowKind kind, Random& random) {
  Times times;
  LitWindow window{};
  const BuildingUse use = household.use;
  const bool dwelling_like =
      use == BuildingUse::residential || use == BuildingUse::mixed || use == BuildingUse::hotel;
  if (kind == WindowKind::stairs) {
    // Lit while somebody walks there, or always.
    if (random.chance(0.22)) times.add(0, night_minutes);
    for (int n = 0; n < 3; ++n) {
      const double at = night_minutes * random.uniform() * random.uniform();
      times.add(at, at + random.range(5, 25));
    }
    window.luminance_cd_m2 = random.range(15, 40);
    window.cct_k = 3000;
  } else if (kind == WindowKind::shop) {
    const bool display = random.chance(0.5);
    times.add(0, around(random, minute_of(20, 0), 45));
    if (display) times.add(0, night_minutes);
    window.luminance_cd_m2 = random.range(60, 200);
    window.cct_k = random.chance(0.5) ? 3000 : 4000;
  } else if (kind == WindowKind::lobby) {
    // Lit all night, or from the first person who comes until the last one leaves.
    if (use == BuildingUse::hotel || random.chance(0.5)) {
      times.add(0, night_minutes);
    } else {
      times.add(0, around(random, minute_of(21, 0), 50));
      times.add(around(random, minute_of(6, 0), 20), night_minutes);
    }
    window.luminance_cd_m2 = random.range(40, 120);
    window.cct_k = use == BuildingUse::hotel ? 2800 : 3500;
  } else if (dwelling_like) {
    dwelling(household, random, times);
    // Half of the windows have curtains or blinds drawn, which let a third of the light through.
    window.luminance_cd_m2 = random.range(10, 50);
    if (random.chance(0.5)) window.luminance_cd_m2 *= 0.35;
    window.cct_k = random.chance(0.8) ? random.range(2600, 3000) : random.range(3000, 4200);
  } else if (use == BuildingUse::industrial || use == BuildingUse::retail) {
    if (household.present) times.add(0, household.all_night ? night_minutes : household.to);
    window.luminance_cd_m2 = random.range(40, 120);
    window.cct_k = 4000;
  } else {
    workplace(household, random, times);
    window.luminance_cd_m2 = random.range(50, 100);
    if (random.chance(0.2)) window.luminance_cd_m2 *= 0.4;
    window.cct_k = random.range(3800, 4200);
  }
  window.schedule = times.schedule();
  return window;
}

}  // namespace nightcity::lights
