#include "tools/town/building_shape.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>

namespace nightcity::town {
namespace {

using glm::dvec2;
using glm::dvec3;

dvec3 lift(const dvec2& p, double z) {
  return {p.x, p.y, z};
}

dvec2 middle(const dvec2& a, const dvec2& b) {
  return (a + b) * 0.5;
}

class Body {
 public:
  explicit Body(const BuildingPlan& plan) : plan_(plan), p_(plan.outline) {}

  std::vector<city::Polygon> build() {
    ground();
    switch (plan_.shape) {
      case Shape::quad:
        quad();
        break;
      case Shape::corner:
        corner();
        break;
      case Shape::courtyard:
        courtyard();
        break;
      case Shape::apse:
        apse();
        break;
    }
    return std::move(polygons_);
  }

 private:
  void add(city::SurfaceType type, city::Ring ring) {
    city::Polygon polygon;
    polygon.surface = type;
    polygon.exterior = std::move(ring);
    polygons_.push_back(std::move(polygon));
  }
  void roof(city::Ring ring) { add(city::SurfaceType::roof, std::move(ring)); }
  dvec3 eave(const dvec2& p) const { return lift(p, plan_.eave_m); }
  dvec3 ridge(const dvec2& p) const { return lift(p, plan_.ridge_m); }

  /// Adds the wall from a to b (outside on the right). `top`: further corners between b's and a's
  /// top, if any.
  void wall(const dvec2& a, const dvec2& b, double top_a, double top_b,
            const city::Ring& top = {}) {
    city::Ring ring{lift(a, plan_.ground_m), lift(b, plan_.ground_m), lift(b, top_b)};
    ring.insert(ring.end(), top.begin(), top.end());
    ring.push_back(lift(a, top_a));
    add(city::SurfaceType::wall, std::move(ring));
  }
  void eave_wall(std::size_t k) {
    wall(p_[k], p_[(k + 1) % p_.size()], plan_.eave_m, plan_.eave_m);
  }

  void ground() {
    city::Polygon polygon;
    polygon.surface = city::SurfaceType::ground;  // seen from below: clockwise from above
    for (auto p = p_.rbegin(); p != p_.rend(); ++p)
      polygon.exterior.push_back(lift(*p, plan_.ground_m));
    if (!plan_.hole.empty()) {
      city::Ring hole;
      for (const dvec2& p : plan_.hole) hole.push_back(lift(p, plan_.ground_m));
      polygon.interiors.push_back(std::move(hole));
    }
    polygons_.push_back(std::move(polygon));
  }

  void flat_roof() {
    city::Polygon polygon;
    polygon.surface = city::SurfaceType::roof;
    for (const dvec2& p : p_) polygon.exterior.push_back(eave(p));
    if (!plan_.hole.empty()) {
      city::Ring hole;
      for (auto p = plan_.hole.rbegin(); p != plan_.hole.rend(); ++p) hole.push_back(eave(*p));
      polygon.interiors.push_back(std::move(hole));
    }
    polygons_.push_back(std::move(polygon));
  }

  void quad() {
    const double depth = glm::length(p_[3] - p_[0]), width = glm::length(p_[1] - p_[0]);
    const dvec2 west = middle(p_[0], p_[3]), east = middle(p_[1], p_[2]);
    switch (plan_.roof) {
      case Roof::flat:
        for (std::size_t k = 0; k < 4; ++k) eave_wall(k);
        return flat_roof();
      case Roof::shed:  // high towards the street
        wall(p_[0], p_[1], plan_.ridge_m, plan_.ridge_m);
        wall(p_[1], p_[2], plan_.ridge_m, plan_.eave_m);
        wall(p_[2], p_[3], plan_.eave_m, plan_.eave_m);
        wall(p_[3], p_[0], plan_.eave_m, plan_.ridge_m);
        return roof({ridge(p_[0]), ridge(p_[1]), eave(p_[2]), eave(p_[3])});
      case Roof::gabled:
        eave_wall(0);
        wall(p_[1], p_[2], plan_.eave_m, plan_.eave_m, {ridge(east)});
        eave_wall(2);
        wall(p_[3], p_[0], plan_.eave_m, plan_.eave_m, {ridge(west)});
        roof({eave(p_[0]), eave(p_[1]), ridge(east), ridge(west)});
        return roof({eave(p_[2]), eave(p_[3]), ridge(west), ridge(east)});
      case Roof::mansard:
        return mansard(west, east);
      case Roof::hipped:
        if (width > depth + 0.5) return hipped(west, east, depth / 2);
        [[fallthrough]];
      case Roof::pyramid:
        return pyramid(middle(west, east));
    }
  }

  void hipped(const dvec2& west, const dvec2& east, double inset) {
    const dvec2 u = glm::normalize(east - west) * inset;
    const dvec3 a = ridge(west + u), b = ridge(east - u);
    for (std::size_t k = 0; k < 4; ++k) eave_wall(k);
    roof({eave(p_[0]), eave(p_[1]), b, a});
    roof({eave(p_[1]), eave(p_[2]), b});
    roof({eave(p_[2]), eave(p_[3]), a, b});
    roof({eave(p_[3]), eave(p_[0]), a});
  }

  void pyramid(const dvec2& apex) {
    for (std::size_t k = 0; k < p_.size(); ++k) {
      eave_wall(k);
      roof({eave(p_[k]), eave(p_[(k + 1) % p_.size()]), ridge(apex)});
    }
  }

  /// Steep slopes towards street and yard, shallow ones above; the gables follow the broken line.
  void mansard(const dvec2& west, const dvec2& east) {
    constexpr double step_in = 0.12;  // of the depth
    const double knee = plan_.eave_m + 0.72 * (plan_.ridge_m - plan_.eave_m);
    const auto inwards = [](const dvec2& from, const dvec2& to) {
      return from + (to - from) * step_in;
    };
    const dvec3 a = lift(inwards(p_[0], p_[3]), knee), b = lift(inwards(p_[1], p_[2]), knee);
    const dvec3 c = lift(inwards(p_[2], p_[1]), knee), d = lift(inwards(p_[3], p_[0]), knee);
    eave_wall(0);
    wall(p_[1], p_[2], plan_.eave_m, plan_.eave_m, {c, ridge(east), b});
    eave_wall(2);
    wall(p_[3], p_[0], plan_.eave_m, plan_.eave_m, {a, ridge(west), d});
    roof({eave(p_[0]), eave(p_[1]), b, a});
    roof({a, b, ridge(east), ridge(west)});
    roof({eave(p_[2]), eave(p_[3]), d, c});
    roof({c, d, ridge(west), ridge(east)});
  }

  /// Two gabled wings that meet in a hip outside and a valley inside.
  void corner() {
    if (plan_.roof == Roof::flat) {
      for (std::size_t k = 0; k < 6; ++k) eave_wall(k);
      return flat_roof();
    }
    const dvec2 end_a = middle(p_[0], p_[5]), end_b = middle(p_[2], p_[3]),
                turn = middle(p_[1], p_[4]);
    for (const std::size_t k : {0u, 1u, 3u, 4u}) eave_wall(k);
    wall(p_[2], p_[3], plan_.eave_m, plan_.eave_m, {ridge(end_b)});
    wall(p_[5], p_[0], plan_.eave_m, plan_.eave_m, {ridge(end_a)});
    roof({eave(p_[0]), eave(p_[1]), ridge(turn), ridge(end_a)});
    roof({eave(p_[1]), eave(p_[2]), ridge(end_b), ridge(turn)});
    roof({eave(p_[3]), eave(p_[4]), ridge(turn), ridge(end_b)});
    roof({eave(p_[4]), eave(p_[5]), ridge(end_a), ridge(turn)});
  }

  void courtyard() {
    const std::vector<dvec2>& q = plan_.hole;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      eave_wall(k);
      wall(q[next], q[k], plan_.eave_m, plan_.eave_m);
      if (plan_.roof == Roof::flat) continue;
      const dvec3 m = ridge(middle(p_[k], q[k])), n = ridge(middle(p_[next], q[next]));
      roof({eave(p_[k]), eave(p_[next]), n, m});
      roof({eave(q[next]), eave(q[k]), m, n});
    }
    if (plan_.roof == Roof::flat) flat_roof();
  }

  void apse() {
    const dvec3 apex = ridge(middle(p_[0], p_[1]));
    wall(p_[0], p_[1], plan_.eave_m, plan_.eave_m, {apex});
    for (std::size_t k = 1; k < p_.size(); ++k) {
      eave_wall(k);
      roof({eave(p_[k]), eave(p_[(k + 1) % p_.size()]), apex});
    }
  }

  const BuildingPlan& plan_;
  const std::vector<dvec2>& p_;
  std::vector<city::Polygon> polygons_;
};

}  // namespace

std::vector<city::Polygon> make_surfaces(const BuildingPlan& plan) {
  return Body(plan).build();
}

}  // namespace nightcity::town
