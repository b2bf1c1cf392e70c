#include "tools/town/roads.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nightcity::town {
namespace {

using glm::dvec2;

/// Covers the quad a-b-c-d (counter-clockwise) with rings no longer than the terrain's grid, lifted
/// above it.
class Drape {
 public:
  explicit Drape(const Hills& hills) : hills_(hills) {}

  void quad(RoadArea& area, const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& d,
            double lift) const {
    const double longest = std::max(glm::distance(a, b), glm::distance(d, c));
    const double widest = std::max(glm::distance(b, c), glm::distance(a, d));
    const int nu = pieces(longest), nv = pieces(widest);
    const auto at = [&](int u, int v) {
      const double fu = static_cast<double>(u) / nu, fv = static_cast<double>(v) / nv;
      const dvec2 p = glm::mix(glm::mix(a, b, fu), glm::mix(d, c, fu), fv);
      return glm::dvec3(p, hills_.height(p) + lift);
    };
    for (int v = 0; v < nv; ++v)
      for (int u = 0; u < nu; ++u) {
        // Four draped corners rarely lie in a plane: two triangles always do.
        area.rings.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1)});
        area.rings.push_back({at(u, v), at(u + 1, v + 1), at(u, v + 1)});
      }
  }

  /// Adds the upright face below the edge a-b, seen from its right: a kerb, without which the
  /// camera would look under the pavement.
  void face(RoadArea& area, const dvec2& a, const dvec2& b, double bottom_lift,
            double top_lift) const {
    const int n = pieces(glm::distance(a, b));
    const auto at = [&](int u, double lift) {
      const dvec2 p = glm::mix(a, b, static_cast<double>(u) / n);
      return glm::dvec3(p, hills_.height(p) + lift);
    };
    for (int u = 0; u < n; ++u)
      area.rings.push_back(
          {at(u, bottom_lift), at(u + 1, bottom_lift), at(u + 1, top_lift), at(u, top_lift)});
  }

 private:
  static int pieces(double length) {
    return std::max(1, static_cast<int>(std::ceil(length / 8.0)));
  }
  const Hills& hills_;
};

/// The diagonal path through a park, from the pavement of its south-west to that of its north-east
/// corner.
Stretch path_of(const StreetPlan& streets, int i, int j) {
  const Quad parcel = streets.parcel(i, j);
  Stretch s;
  s.i = i;
  s.j = j;
  s.axis = 2;
  s.street = StreetClass::footway;
  s.from = parcel[0];
  s.to = parcel[2];
  const dvec2 u = glm::normalize(s.to - s.from);
  const dvec2 left = dvec2(-u.y, u.x) * (size_of(s.street).carriageway_m / 2);
  s.from += u * 2.0;  // so that its corners stay inside the parcel
  s.to -= u * 2.0;
  s.kerb_left[0] = s.from + left, s.kerb_left[1] = s.to + left;
  s.kerb_right[0] = s.from - left, s.kerb_right[1] = s.to - left;
  return s;
}

RoadPlan road_of(const Stretch& s, const char* kind) {
  RoadPlan road;
  road.kind = kind;
  road.i = s.i;
  road.j = s.j;
  road.axis = s.axis;
  road.street = s.street;
  return road;
}

}  // namespace

Stretch find_stretch(const StreetPlan& streets, int i, int j, int axis) {
  Stretch s;
  s.i = i;
  s.j = j;
  s.axis = axis;
  if (axis ==
      0) {  // row street (i, j) to (i + 1, j): block (i, j) on the left, (i, j - 1) on the right
    const Quad left = streets.kerb(i, j), right = streets.kerb(i, j - 1);
    s.kerb_left[0] = left[0], s.kerb_left[1] = left[1];
    s.kerb_right[0] = right[3], s.kerb_right[1] = right[2];
    s.street = streets.row_street(i, j);
  } else {  // column street (i, j) to (i, j + 1): block (i - 1, j) on the left, (i, j) on the right
    const Quad left = streets.kerb(i - 1, j), right = streets.kerb(i, j);
    s.kerb_left[0] = left[1], s.kerb_left[1] = left[2];
    s.kerb_right[0] = right[0], s.kerb_right[1] = right[3];
    s.street = streets.column_street(i, j);
  }
  s.from = (s.kerb_left[0] + s.kerb_right[0]) * 0.5;
  s.to = (s.kerb_left[1] + s.kerb_right[1]) * 0.5;
  return s;
}

void for_each_stretch(const StreetPlan& streets, const std::function<void(const Stretch&)>& visit) {
  for (int j = 0; j <= streets.rows(); ++j)
    for (int i = 0; i < streets.columns(); ++i) visit(find_stretch(streets, i, j, 0));
  for (int i = 0; i <= streets.columns(); ++i)
    for (int j = 0; j < streets.rows(); ++j) visit(find_stretch(streets, i, j, 1));
  for (int j = 0; j < streets.rows(); ++j)
    for (int i = 0; i < streets.columns(); ++i)
      if (streets.use(i, j) == BlockUse::park) visit(path_of(streets, i, j));
}

void for_each_road(const StreetPlan& streets, const Hills& hills,
                   const std::function<void(const RoadPlan&)>& visit) {
  const Drape drape(hills);
  for_each_stretch(streets, [&](const Stretch& s) {
    RoadPlan road = road_of(s, s.axis == 2 ? "path" : "road");
    RoadArea lane;
    lane.function = s.street == StreetClass::footway || s.street == StreetClass::pedestrian ? 2 : 1;
    drape.quad(lane, s.kerb_right[0], s.kerb_right[1], s.kerb_left[1], s.kerb_left[0],
               Hills::road_lift_m);
    road.areas.push_back(std::move(lane));
    visit(road);
  });
  for (int j = 0; j <= streets.rows(); ++j)
    for (int i = 0; i <= streets.columns(); ++i) {
      RoadPlan road;
      road.kind = "junction";
      road.i = i;
      road.j = j;
      RoadArea lane;
      drape.quad(lane, streets.kerb(i - 1, j - 1)[2], streets.kerb(i, j - 1)[3],
                 streets.kerb(i, j)[0], streets.kerb(i - 1, j)[1], Hills::road_lift_m);
      road.areas.push_back(std::move(lane));
      visit(road);
    }
  for (int j = 0; j < streets.rows(); ++j)
    for (int i = 0; i < streets.columns(); ++i) {
      const Quad kerb = streets.kerb(i, j), parcel = streets.parcel(i, j);
      RoadPlan road;
      road.kind = "pavement";
      road.i = i;
      road.j = j;
      RoadArea paving;
      paving.function = 2;
      const bool market =
          streets.use(i, j) == BlockUse::market;  // paved on, so without an inner edge
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        drape.quad(paving, kerb[k], kerb[next], parcel[next], parcel[k], Hills::pavement_lift_m);
        drape.face(paving, kerb[k], kerb[next], 0.0, Hills::pavement_lift_m);
        if (!market) drape.face(paving, parcel[next], parcel[k], 0.0, Hills::pavement_lift_m);
      }
      road.areas.push_back(std::move(paving));
      if (market) {
        RoadArea square;
        square.function = 5;
        drape.quad(square, parcel[0], parcel[1], parcel[2], parcel[3], Hills::pavement_lift_m);
        road.areas.push_back(std::move(square));
      }
      visit(road);
    }
}

}  // namespace nightcity::town
