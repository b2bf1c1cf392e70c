#include "tools/town/building_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "tools/random.h"

namespace nightcity::town {
namespace {

using glm::dvec2;

/// One side of a block with its own axes: s along the street, y into the block.
struct Side {
  dvec2 start, along, inward;
  double length;
  dvec2 at(double s, double y) const { return start + along * s + inward * y; }
  double depth_of(const dvec2& p) const { return glm::dot(p - start, inward); }
};

Side side_of(const Quad& quad, std::size_t k) {
  const dvec2 edge = quad[(k + 1) % 4] - quad[k];
  const double length = glm::length(edge);
  const dvec2 along = edge / length;
  return {quad[k], along, {-along.y, along.x}, length};
}

/// Shape of the block's ground and who may build there.
class Block {
 public:
  Block(const StreetPlan& streets, const Hills& hills, std::uint64_t seed, int i, int j)
      : hills_(hills),
        parcel_(streets.parcel(i, j)),
        remoteness_(streets.remoteness(i, j)),
        random_{static_cast<std::int64_t>(seed), 9, i, j} {
    for (std::size_t k = 0; k < 4; ++k) side_[k] = side_of(parcel_, k);
  }

  std::vector<BuildingPlan> build(BlockUse use) {
    switch (use) {
      case BlockUse::market:
        church();
        break;
      case BlockUse::park:
        break;
      case BlockUse::courtyard:
        courtyard();
        break;
      case BlockUse::perimeter:
        if (!perimeter()) houses();
        break;
      case BlockUse::slabs:
        slabs();
        break;
      case BlockUse::hall:
        hall();
        break;
      case BlockUse::houses:
        houses();
        break;
    }
    return std::move(plans_);
  }

 private:
  /// Stands a plan on its ground: the ground surface at the lowest corner, storeys counted from the mean.
  void stand(BuildingPlan& plan, double storey_m, double plinth_m) {
    double lowest = std::numeric_limits<double>::infinity(), sum = 0;
    for (const dvec2& p : plan.outline) {
      const double z = hills_.height(p);
      lowest = std::min(lowest, z);
      sum += z;
    }
    plan.ground_m = lowest - 0.3;
    plan.eave_m =
        sum / static_cast<double>(plan.outline.size()) + plinth_m + plan.storeys * storey_m;
  }

  void roof_over(BuildingPlan& plan, Roof roof, double depth_m, double pitch_degrees) {
    plan.roof = roof;
    const double rise = depth_m / 2 * std::tan(glm::radians(pitch_degrees));
    if (roof == Roof::flat)
      plan.ridge_m = plan.eave_m;
    else if (roof == Roof::shed)
      plan.ridge_m = plan.eave_m + depth_m * std::tan(glm::radians(9.0));
    else if (roof == Roof::mansard)
      plan.ridge_m = plan.eave_m + 3.4 + 0.12 * depth_m;
    else
      plan.ridge_m = plan.eave_m + rise;
  }

  int core_storeys() {
    const int top = remoteness_ < 0.35 ? 6 : remoteness_ < 0.65 ? 5 : 4;
    return random_.integer(std::max(2, top - 2), top);
  }

  const char* core_function() {
    const double pick = random_.uniform();
    const double shops = 0.45 - 0.4 * remoteness_;
    if (pick < shops) return "31001_1120";         // dwellings with shops
    if (pick < shops + 0.10) return "31001_2020";  // offices
    if (pick < shops + 0.13) return "31001_2071";  // hotel
    if (pick < shops + 0.18) return "31001_2050";  // shops
    return "31001_1010";                           // dwellings
  }

  int old_year() {
    return random_.chance(0.7) ? random_.integer(1870, 1914) : random_.integer(1920, 2015);
  }

  /// Houses wall to wall round the block with a yard inside. False where the block is too small or too skew.
  bool perimeter() {
    const double depth = random_.range(11.0, 13.5);
    const Quad inner = inset_quad(parcel_, {depth, depth, depth, depth});
    double reach[4];  // how far a corner house's inner corner lies along its sides
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t before = (k + 3) % 4;
      for (const std::size_t across : {(k + 2) % 4, (k + 3) % 4})
        if (side_[k].depth_of(inner[across]) < depth + 7) return false;
      const double here = glm::dot(inner[k] - parcel_[k], side_[k].along);
      const double there = glm::dot(parcel_[k] - inner[k], side_[before].along);
      reach[k] = std::max(here, there) + random_.range(2.5, 6.0);
    }
    for (std::size_t k = 0; k < 4; ++k)
      if (side_[k].length < reach[k] + reach[(k + 1) % 4] + 8) return false;

    const bool old_town = random_.chance(0.8);
    for (std::size_t k = 0; k < 4; ++k) {
      corner_house(k, reach[k], depth, inner[k], old_town);
      row(side_[k], reach[k], side_[k].length - reach[(k + 1) % 4], depth, old_town);
    }
    rear_house(inner);
    return true;
  }

  void corner_house(std::size_t k, double reach, double depth, const dvec2& inner, bool old_town) {
    const Side &a = side_[(k + 3) % 4], &b = side_[k];
    BuildingPlan plan;
    plan.shape = Shape::corner;
    plan.outline = {a.at(a.length - reach, 0), parcel_[k], b.at(reach, 0),
                    b.at(reach, depth),        inner,      a.at(a.length - reach, depth)};
    plan.storeys = core_storeys();
    plan.function = core_function();
    plan.year = old_year();
    stand(plan, old_town ? 3.5 : 3.0, 0.8);
    const double slope_deg = random_.range(35, 45);
    roof_over(plan, random_.chance(0.8) ? Roof::gabled : Roof::flat, depth, slope_deg);
    plans_.push_back(std::move(plan));
  }

  void row(const Side& side, double from, double to, double depth, bool old_town) {
    const int lots = std::max(1, static_cast<int>(std::lround((to - from) / random_.range(9, 15))));
    const int common_storeys = core_storeys();
    for (int n = 0; n < lots; ++n) {
      const double s0 = from + (to - from) * n / lots, s1 = from + (to - from) * (n + 1) / lots;
      if (random_.chance(0.02)) continue;  // a gap in the row
      BuildingPlan plan;
      plan.outline = {side.at(s0, 0), side.at(s1, 0), side.at(s1, depth), side.at(s0, depth)};
      plan.storeys = std::clamp(common_storeys + random_.integer(-1, 1), 2, 7);
      plan.function = core_function();
      plan.year = old_year();
      stand(plan, old_town ? random_.range(3.3, 3.6) : random_.range(2.9, 3.1), 0.8);
      const double pick = random_.uniform();
      const Roof roof = pick < 0.62   ? Roof::gabled
                        : pick < 0.78 ? Roof::mansard
                        : pick < 0.92 ? Roof::flat
                                      : Roof::shed;
      roof_over(plan, roof, depth, random_.range(35, 47));
      plans_.push_back(std::move(plan));
    }
  }

  /// The lower house in the yard that deep blocks have.
  void rear_house(const Quad& yard) {
    const dvec2 centre = (yard[0] + yard[1] + yard[2] + yard[3]) / 4.0;
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) room = std::min(room, side_of(yard, k).depth_of(centre));
    if (room < 11 || random_.chance(0.3)) return;
    const double half =
        (room - 4) / std::numbers::sqrt2;  // stays inside the circle that touches the yard's walls
    BuildingPlan plan = rectangle(centre - side_[0].along * half - side_[0].inward * (half * 0.7),
                                  side_[0].along, 2 * half, 1.4 * half);
    plan.storeys = random_.integer(1, 3);
    plan.function = random_.chance(0.5) ? "31001_2143" : "31001_1010";  // store, dwellings
    plan.year = old_year();
    stand(plan, 3.2, 0.2);
    roof_over(plan, random_.chance(0.5) ? Roof::shed : Roof::flat, 1.4 * half, 30);
    plans_.push_back(std::move(plan));
  }

  static BuildingPlan rectangle(const dvec2& corner, const dvec2& along, double length,
                                double depth) {
    const dvec2 u = along * length, v = dvec2(-along.y, along.x) * depth;
    BuildingPlan plan;
    plan.outline = {corner, corner + u, corner + u + v, corner + v};
    return plan;
  }

  /// One public building round a yard: town hall, school, museum.
  void courtyard() {
    const double setback = random_.range(2, 5), depth = random_.range(13, 15);
    const Quad outer = inset_quad(parcel_, {setback, setback, setback, setback});
    const Quad inner = inset_quad(outer, {depth, depth, depth, depth});
    for (std::size_t k = 0; k < 4; ++k)
      for (const std::size_t across : {(k + 2) % 4, (k + 3) % 4})
        if (side_of(outer, k).depth_of(inner[across]) < depth + 8) return houses();
    BuildingPlan plan;
    plan.shape = Shape::courtyard;
    plan.outline.assign(outer.begin(), outer.end());
    plan.hole.assign(inner.begin(), inner.end());
    plan.storeys = random_.integer(3, 4);
    constexpr const char* uses[] = {"31001_3012", "31001_3021", "31001_3034", "31001_2020"};
    plan.function = uses[random_.integer(0, 3)];  // town hall, school, museum, offices
    plan.year = random_.integer(1880, 1980);
    stand(plan, 4.0, 1.0);
    const double slope_deg = random_.range(30, 40);
    roof_over(plan, random_.chance(0.6) ? Roof::gabled : Roof::flat, depth, slope_deg);
    plans_.push_back(std::move(plan));
  }

  /// Detached and semi-detached houses in gardens along all four sides.
  void houses() {
    const double setback = random_.range(3.5, 6), deepest = 12.5, gap = 3.2;
    const double clear =
        setback + deepest + gap;  // the strip beside a street that its own houses may use
    for (std::size_t k = 0; k < 4; ++k) {
      const bool first_choice = k % 2 == 0;  // sides 0 and 2 build up to the corners
      double s = setback;
      while (s < side_[k].length - setback - 9) {
        const double lot = random_.range(13, 19);
        const double width = std::min(random_.range(9, 14), lot - gap),
                     depth = random_.range(8.5, deepest);
        const double front = setback + random_.range(0, deepest - depth);
        BuildingPlan plan = rectangle(side_[k].at(s, front), side_[k].along, width, depth);
        s += lot;
        bool fits = true;
        for (std::size_t other = 0; other < 4; ++other) {
          if (other == k) continue;
          const double distance = first_choice && other % 2 == 1 ? setback : clear;
          for (const dvec2& p : plan.outline) fits = fits && side_[other].depth_of(p) >= distance;
        }
        if (fits) house(plan, width, depth);
      }
    }
  }

  void house(BuildingPlan& plan, double width, double depth) {
    plan.storeys = random_.chance(0.65) ? 1 : 2;
    plan.year = random_.integer(1925, 2020);
    plan.function = "31001_1010";
    stand(plan, 2.9, 0.5);
    const double pick = random_.uniform();
    const Roof roof = pick < 0.55                                  ? Roof::gabled
                      : pick < 0.80                                ? Roof::hipped
                      : pick < 0.88 || std::abs(width - depth) < 1 ? Roof::pyramid
                      : pick < 0.94                                ? Roof::shed
                                                                   : Roof::flat;
    roof_over(plan, roof, depth, random_.range(28, 48));
    plans_.push_back(std::move(plan));
  }

  /// Two long blocks of flats in parallel, lawn between.
  void slabs() {
    const std::size_t k = side_[0].length > side_[1].length ? 0 : 1;
    const Side &near = side_[k], &far = side_[k + 2];
    const double depth = 12, setback = 7;
    for (const Side* side : {&near, &far}) {
      BuildingPlan plan = rectangle(side->at(14, setback), side->along, side->length - 28, depth);
      const Side& opposite = side == &near ? far : near;
      bool fits = side->length > 50;
      for (const dvec2& p : plan.outline) fits = fits && opposite.depth_of(p) > setback + depth + 6;
      for (std::size_t other : {(k + 1) % 4, (k + 3) % 4})
        for (const dvec2& p : plan.outline) fits = fits && side_[other].depth_of(p) > 4;
      if (!fits) continue;
      plan.storeys = random_.integer(5, 9);
      plan.year = random_.integer(1960, 1985);
      stand(plan, 2.8, 1.0);
      roof_over(plan, Roof::flat, depth, 0);
      plans_.push_back(std::move(plan));
    }
    if (plans_.empty()) houses();
  }

  /// A supermarket or workshop behind its car park.
  void hall() {
    const dvec2 centre = (parcel_[0] + parcel_[1] + parcel_[2] + parcel_[3]) / 4.0;
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) room = std::min(room, side_[k].depth_of(centre));
    const double half = (room - 3) / std::numbers::sqrt2;
    BuildingPlan plan = rectangle(centre - side_[0].along * half - side_[0].inward * half,
                                  side_[0].along, 2 * half, 2 * half);
    plan.storeys = 1;
    plan.year = random_.integer(1975, 2020);
    plan.function = random_.chance(0.6) ? "31001_2050" : "31001_2111";  // shop, factory
    stand(plan, random_.range(5, 8), 0.2);
    roof_over(plan, random_.chance(0.7) ? Roof::flat : Roof::shed, 2 * half, 0);
    plans_.push_back(std::move(plan));
  }

  /// Church on the market square: nave, west tower, apse in the east.
  void church() {
    const dvec2 centre = (parcel_[0] + parcel_[1] + parcel_[2] + parcel_[3]) / 4.0;
    const double half = 7, length = 30;
    const dvec2 u = side_[0].along, v = side_[0].inward;
    BuildingPlan nave = rectangle(centre - u * (length / 2) - v * half, u, length, 2 * half);
    nave.function = "31001_3041";
    nave.year = random_.integer(1250, 1500);
    nave.storeys = 1;
    stand(nave, 13, 0.5);
    roof_over(nave, Roof::gabled, 2 * half, 56);

    BuildingPlan tower = rectangle(centre - u * (length / 2 + 8) - v * 4.0, u, 8, 8);
    stand(tower, 32, 0.5);
    tower.roof = Roof::pyramid;
    tower.ridge_m = tower.eave_m + 24;

    BuildingPlan apse;
    apse.shape = Shape::apse;
    const dvec2 east = centre + u * (length / 2);
    for (int n = 0; n <= 6; ++n) {
      // From the north end of the nave's gable round the east to the south end, then counter-clockwise again.
      const double angle = -std::numbers::pi / 2 + std::numbers::pi * n / 6;
      apse.outline.push_back(east + u * (5.0 * std::cos(angle)) + v * (5.0 * std::sin(angle)));
    }
    std::rotate(apse.outline.begin(), apse.outline.end() - 1,
                apse.outline.end());  // edge 0 on the gable
    stand(apse, 9, 0.5);
    apse.ridge_m = apse.eave_m + 4;
    for (BuildingPlan* part : {&tower, &apse}) {
      part->function = nave.function;
      part->year = nave.year;
      nave.parts.push_back(std::move(*part));
    }
    plans_.push_back(std::move(nave));
  }

  const Hills& hills_;
  Quad parcel_;
  Side side_[4];
  double remoteness_;
  Random random_;
  std::vector<BuildingPlan> plans_;
};

}  // namespace

std::vector<BuildingPlan> plan_block(const StreetPlan& streets, const Hills& hills,
                                     std::uint64_t seed, int i, int j) {
  return Block(streets, hills, seed, i, j).build(streets.use(i, j));
}

}  // namespace nightcity::town
