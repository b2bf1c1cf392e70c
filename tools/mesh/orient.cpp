#include "tools/mesh/orient.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "tools/mesh/polygon_plane.h"

namespace nightcity::mesh {
namespace {

struct Shell {
  std::vector<std::uint32_t> polygons;
  bool consistent = true;  // no polygon had to face both ways
  bool closed = true;
  double volume = 0;  // with its polygons turned
  // In plan: roofs and floors, and how much of them faces out (roofs up, floors down) less the
  // rest.
  double roofs_m2 = 0, floors_m2 = 0, roofs_out_m2 = 0, floors_out_m2 = 0;
  bool has_walls = false;
  glm::dvec3 low{std::numeric_limits<double>::infinity()},
      high{-std::numeric_limits<double>::infinity()};
};

constexpr std::uint32_t no_shell = std::numeric_limits<std::uint32_t>::max();

class Orienter {
 public:
  Orienter(city::CityObject& object, const EdgeTable& edges)
      : object_(object),
        edges_(edges),
        turned_(object.polygons.size(), false),
        shell_of_(object.polygons.size(), no_shell) {}

  void run(MeshReport& report) {
    find_shells();
    std::size_t turned = 0;
    bool open = false;
    for (std::size_t i = 0; i < shells_.size(); ++i) {
      const Shell& shell = shells_[i];
      open = open || !shell.closed || !shell.consistent;
      if (!shell.consistent || !is_known(shell) || is_enclosed(i)) continue;
      const bool faces_out = shell.closed ? shell.volume > 0 : shell.roofs_out_m2 > 0;
      for (const std::uint32_t p : shell.polygons) {
        if (turned_[p] == faces_out) {
          turn(object_.polygons[p]);
          ++turned;
        }
      }
    }
    if (object_.type == city::ObjectType::building) report.open_objects += open;
    if (turned == 0) return;
    report.turned += turned;
    if (report.first_turned.empty()) report.first_turned = object_.id;
  }

 private:
  // Which way is out shows in the volume of a closed shell; in an open one the file says which of
  // its polygons are roofs and floors, of which eaves and passages may face the other way.
  // Both must say the same, and all polygons must agree: beside a gap an edge may be that of an
  // inner wall, behind which all others would be turned.
  bool is_known(const Shell& shell) const {
    if (shell.closed) return shell.volume != 0;
    const auto is_turned = [&](std::uint32_t p) { return turned_[p]; };
    if (std::any_of(shell.polygons.begin(), shell.polygons.end(), is_turned)) return false;
    const auto is_clear = [](double out, double all) { return std::abs(out) > all / 2; };
    return shell.has_walls && is_clear(shell.roofs_out_m2, shell.roofs_m2) &&
           is_clear(shell.floors_out_m2, shell.floors_m2) &&
           (shell.roofs_out_m2 > 0) == (shell.floors_out_m2 > 0);
  }

  static void turn(city::Polygon& polygon) {
    std::reverse(polygon.exterior.begin(), polygon.exterior.end());
    for (city::Ring& ring : polygon.interiors) std::reverse(ring.begin(), ring.end());
  }

  // Neighbours share an edge that no third polygon has; facing the same way, they run along it in
  // opposite directions.
  void find_shells() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t start = 0; start < object_.polygons.size(); ++start) {
      if (shell_of_[start] != no_shell || edges_.of_polygon(start).empty()) continue;
      Shell shell;
      const auto number = static_cast<std::uint32_t>(shells_.size());
      open.assign(1, start);
      shell_of_[start] = number;
      while (!open.empty()) {
        const std::uint32_t p = open.back();
        open.pop_back();
        shell.polygons.push_back(p);
        for (const std::uint32_t i : edges_.of_polygon(p)) {
          const auto uses = edges_.edge_of(i);
          if (uses.size() != 2 || uses[0].polygon == uses[1].polygon) continue;
          const EdgeUse &mine = uses[uses[0].polygon == p ? 0 : 1],
                        &other = uses[uses[0].polygon == p ? 1 : 0];
          const bool turn_other = turned_[p] != (mine.forward == other.forward);
          if (shell_of_[other.polygon] == no_shell) {
            shell_of_[other.polygon] = number;
            turned_[other.polygon] = turn_other;
            open.push_back(other.polygon);
          } else if (turned_[other.polygon] != turn_other) {
            shell.consistent = false;
          }
        }
      }
      measure(shell, number);
      shells_.push_back(std::move(shell));
    }
  }

  void measure(Shell& shell, std::uint32_t number) {
    std::sort(shell.polygons.begin(), shell.polygons.end());
    const glm::dvec3 origin = object_.polygons[shell.polygons.front()].exterior.front();
    for (const std::uint32_t i : shell.polygons) {
      const city::Polygon& polygon = object_.polygons[i];
      glm::dvec3 vector = city::area_vector(polygon.exterior);
      for (const city::Ring& hole : polygon.interiors) {
        const glm::dvec3 h = city::area_vector(hole);
        vector -= glm::dot(h, vector) > 0 ? h : -h;
      }
      const double up_m2 = turned_[i] ? -vector.z : vector.z;
      if (polygon.surface == city::SurfaceType::roof) {
        shell.roofs_m2 += std::abs(up_m2);
        shell.roofs_out_m2 += up_m2;
      } else if (polygon.surface == city::SurfaceType::ground) {
        shell.floors_m2 += std::abs(up_m2);
        shell.floors_out_m2 -= up_m2;
      }
      shell.has_walls = shell.has_walls || polygon.surface == city::SurfaceType::wall;
      // Divergence theorem: a third of each face's area vector times any point of it.
      shell.volume +=
          glm::dot(vector, polygon.exterior.front() - origin) / 3 * (turned_[i] ? -1 : 1);
      for (const glm::dvec3& p : polygon.exterior) {
        shell.low = glm::min(shell.low, p);
        shell.high = glm::max(shell.high, p);
      }
      for (const std::uint32_t u : edges_.of_polygon(i)) {
        int balance = 0;
        for (const EdgeUse& use : edges_.edge_of(u))
          if (shell_of_[use.polygon] == number)
            balance += use.forward != turned_[use.polygon] ? 1 : -1;
        if (balance != 0) shell.closed = false;
      }
    }
  }

  // A shell within another may be its cavity, which faces the other way: nothing can be shown
  // there.
  bool is_enclosed(std::size_t i) const {
    constexpr std::size_t max_shells = 2000;  // every pair is looked at: beyond, nothing is turned
    if (shells_.size() > max_shells) return true;
    const Shell& inner = shells_[i];
    for (std::size_t j = 0; j < shells_.size(); ++j) {
      const Shell& outer = shells_[j];
      if (j != i && outer.closed && glm::all(glm::lessThan(outer.low, inner.low)) &&
          glm::all(glm::lessThan(inner.high, outer.high)))
        return true;
    }
    return false;
  }

  city::CityObject& object_;
  const EdgeTable& edges_;
  std::vector<bool> turned_;
  std::vector<std::uint32_t> shell_of_;  // of each polygon; `no_shell` before it is reached
  std::vector<Shell> shells_;
};

}  // namespace

bool has_finite_places(const city::CityObject& object) {
  constexpr double beyond_any_frame_m = 1e9;
  const auto within = [](const city::Ring& ring) {
    return std::all_of(ring.begin(), ring.end(), [](const glm::dvec3& p) {
      return std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < beyond_any_frame_m;
    });
  };
  return std::all_of(
      object.polygons.begin(), object.polygons.end(), [&](const city::Polygon& polygon) {
        return within(polygon.exterior) &&
               std::all_of(polygon.interiors.begin(), polygon.interiors.end(), within);
      });
}

void orient_along(city::CityObject& object, const EdgeTable& edges, MeshReport& report) {
  Orienter(object, edges).run(report);
}

void orient_outward(city::CityObject& object, MeshReport& report) {
  if (object.type == city::ObjectType::relief || !has_finite_places(object)) return;
  orient_along(object, EdgeTable(object), report);
}

}  // namespace nightcity::mesh
