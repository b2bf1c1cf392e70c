#include "tools/mesh/simplify_outlines.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace nightcity::mesh {
namespace {

using Index = std::uint32_t;
constexpr Index none = 0xFFFFFFFFu;

// A place that rings pass, and its neighbours while all of them pass it alike.
struct RingCorner {
  glm::dvec3 place;
  Index one = none, other = none;
  bool is_between = true;  // the same two in every ring
};

double distance_to_edge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 edge = b - a;
  const double square = glm::dot(edge, edge),
               t = square > 0 ? std::clamp(glm::dot(p - a, edge) / square, 0.0, 1.0) : 0;
  return glm::distance(p, a + t * edge);
}

class Simplifier {
 public:
  Simplifier(city::CityObject& object, double tolerance_m) : tolerance_m_(tolerance_m) {
    for (city::Polygon& polygon : object.polygons) {
      add(polygon.exterior);
      for (city::Ring& ring : polygon.interiors) add(ring);
    }
    for (RingCorner& corner : corners_)
      corner.is_between &= corner.one != none && corner.one != corner.other;
  }

  std::size_t run() {
    is_left_out_.assign(corners_.size(), false);
    std::vector<bool> is_done(corners_.size());
    for (Index start = 0; start < corners_.size(); ++start) {
      if (!corners_[start].is_between || is_done[start]) continue;
      const std::vector<Index> chain = find_chain(start);
      for (const Index corner : chain) is_done[corner] = true;
      thin(chain);
    }
    keep_three_in_each_ring();
    return apply();
  }

 private:
  void add(city::Ring& ring) {
    std::vector<Index>& indices = rings_.emplace_back(&ring, std::vector<Index>()).second;
    for (const glm::dvec3& p : ring) {
      const auto [found, is_new] =
          index_of_.try_emplace({p.x, p.y, p.z}, static_cast<Index>(corners_.size()));
      if (is_new) corners_.push_back({p});
      indices.push_back(found->second);
    }
    for (std::size_t n = 0; n < indices.size(); ++n)
      pass(indices[n], indices[(n + indices.size() - 1) % indices.size()],
           indices[(n + 1) % indices.size()]);
  }

  void pass(Index at, Index before, Index after) {
    RingCorner& corner = corners_[at];
    if (before > after) std::swap(before, after);
    if (corner.one == none) {
      corner.one = before;
      corner.other = after;
    } else if (corner.one != before || corner.other != after) {
      corner.is_between = false;
    }
  }

  // Returns the corners from one that stays, over `start`, to the next that does. In a loop of
  // corners that could all go, `start` stays.
  std::vector<Index> find_chain(Index start) const {
    std::vector<Index> chain{start};
    const auto walk = [&](Index from, Index to) {
      while (true) {
        chain.push_back(to);
        if (!corners_[to].is_between || to == start) return;
        const Index next = corners_[to].one == from ? corners_[to].other : corners_[to].one;
        from = std::exchange(to, next);
      }
    };
    walk(start, corners_[start].one);
    if (chain.back() == start) return chain;
    std::reverse(chain.begin(), chain.end());
    walk(start, corners_[start].other);
    return chain;
  }

  void thin(const std::vector<Index>& chain) {
    for (const Index corner : chain)
      is_left_out_[corner] = is_left_out_[corner] || corners_[corner].is_between;
    is_left_out_[chain.front()] = is_left_out_[chain.back()] = false;
    std::vector<std::pair<std::size_t, std::size_t>> spans{{0, chain.size() - 1}};
    while (!spans.empty()) {
      const auto [begin, end] = spans.back();
      spans.pop_back();
      std::size_t worst = begin;
      double error = tolerance_m_;
      for (std::size_t n = begin + 1; n < end; ++n) {
        const double distance = distance_to_edge(
            corners_[chain[n]].place, corners_[chain[begin]].place, corners_[chain[end]].place);
        if (distance > error) {
          error = distance;
          worst = n;
        }
      }
      if (worst == begin) continue;
      is_left_out_[chain[worst]] = false;
      spans.emplace_back(begin, worst);
      spans.emplace_back(worst, end);
    }
  }

  // A corner that comes back into one ring does so in all of them.
  void keep_three_in_each_ring() {
    for (const auto& [ring, indices] : rings_) {
      const auto kept = std::count_if(indices.begin(), indices.end(),
                                      [this](Index n) { return !is_left_out_[n]; });
      if (kept < 3)
        for (const Index n : indices) is_left_out_[n] = false;
    }
  }

  std::size_t apply() {
    for (const auto& [ring, indices] : rings_) {
      city::Ring kept;
      for (std::size_t n = 0; n < indices.size(); ++n)
        if (!is_left_out_[indices[n]]) kept.push_back((*ring)[n]);
      *ring = std::move(kept);
    }
    return static_cast<std::size_t>(std::count(is_left_out_.begin(), is_left_out_.end(), true));
  }

  double tolerance_m_;
  std::map<std::tuple<double, double, double>, Index> index_of_;
  std::vector<RingCorner> corners_;
  std::vector<std::pair<city::Ring*, std::vector<Index>>> rings_;
  std::vector<bool> is_left_out_;
};

}  // namespace

std::size_t simplify_outlines(city::CityObject& object, double tolerance_m) {
  if (!(tolerance_m > 0)) return 0;
  return Simplifier(object, tolerance_m).run();
}

}  // namespace nightcity::mesh
