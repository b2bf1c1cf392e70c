#include "tools/streets/street_network.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string_view>
#include <tuple>
#include <utility>

#include "tools/line.h"
#include "tools/osm/tag_values.h"

namespace nightcity::streets {
namespace {

using NodeKey =
    std::pair<std::int64_t, std::int64_t>;  // OSM's own resolution: equal keys are one node
constexpr double shortest_m = 0.01,
                 longest_m = 1e5;  // longer jumps between nodes are a broken extract

NodeKey key_of(const glm::dvec2& lon_lat) {
  return {std::llround(lon_lat.x * 1e7), std::llround(lon_lat.y * 1e7)};
}

/// A run of one way's nodes between two junctions or ends.
struct Run {
  Street street;
  NodeKey first, last;
};

bool same_road(const roads::Carriageway& a, const roads::Carriageway& b) {
  return roads::main_highway(a.road_class->highway) == roads::main_highway(b.road_class->highway) &&
         std::abs(a.width_m - b.width_m) <= 1;
}

void reverse(Run& run) {
  Street& street = run.street;
  const double length = street.length_m();
  std::reverse(street.line.begin(), street.line.end());
  std::reverse(street.at_m.begin(), street.at_m.end());
  for (double& at : street.at_m) at = length - at;
  std::reverse(street.pieces.begin(), street.pieces.end());
  for (Street::Piece& piece : street.pieces) std::swap(piece.from_m, piece.to_m);
  std::swap(run.first, run.last);
}

void append(Run& to, const Run& next) {
  const double length = to.street.length_m();
  to.street.line.insert(to.street.line.end(), next.street.line.begin() + 1, next.street.line.end());
  for (std::size_t n = 1; n < next.street.at_m.size(); ++n)
    to.street.at_m.push_back(length + next.street.at_m[n]);
  to.street.pieces.insert(to.street.pieces.end(), next.street.pieces.begin(),
                          next.street.pieces.end());
  // Posts along the whole street stand behind its widest kerb.
  to.street.road.width_m = std::max(to.street.road.width_m, next.street.road.width_m);
  if (to.street.name.empty()) to.street.name = next.street.name;
  to.last = next.last;
}

// An order of runs that their places and tags decide. Ids only tell apart ways that are drawn
// twice.
bool comes_first(const Run& a, const Run& b) {
  const Street &x = a.street, &y = b.street;
  if (comes_before_either_way(x.line, y.line)) return true;
  if (comes_before_either_way(y.line, x.line)) return false;
  if (comes_before(x.line, y.line)) return true;
  if (comes_before(y.line, x.line)) return false;
  const auto key = [](const Street& street) {
    return std::tuple(-street.road.width_m, std::string_view(street.road.road_class->highway),
                      std::string_view(street.name), street.pieces.front().way_id);
  };
  return key(x) < key(y);
}

class NetworkBuilder {
 public:
  void count(const osm::OsmWay& way) {
    for (std::size_t n = 0; n < way.lon_lat.size(); ++n) {
      // At a node inside a way, two of its runs would end.
      const bool end = n == 0 || n + 1 == way.lon_lat.size();
      degrees_[key_of(way.lon_lat[n])] += end ? 1 : 2;
    }
  }

  void cut(const osm::OsmWay& way, const roads::Carriageway& road,
           const std::function<glm::dvec2(const glm::dvec2&)>& to_frame) {
    Street fresh;
    fresh.road = road;
    fresh.name = osm::find_raw_tag(way.tags, "name");
    Run run{fresh, {}, {}};
    double on_way = 0;
    const auto finish = [&](const NodeKey& key) {
      run.last = key;
      if (run.street.line.size() > 1) runs_.push_back(std::move(run));
      run = Run{fresh, {}, {}};
    };
    for (std::size_t n = 0; n < way.lon_lat.size(); ++n) {
      const glm::dvec2 p = to_frame(way.lon_lat[n]);
      const NodeKey key = key_of(way.lon_lat[n]);
      Street& street = run.street;
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
        if (!street.line.empty()) finish(last_key_);
        continue;
      }
      if (!street.line.empty()) {
        const double step = glm::distance(street.line.back(), p);
        if (step > longest_m) {
          finish(last_key_);
        } else if (step < shortest_m) {
          if (degrees_[key] > 2)
            finish(key);  // two nodes on one spot, one of them a junction
          else
            continue;
        } else {
          street.pieces.push_back({way.id, on_way, on_way + step});
          on_way += step;
          street.at_m.push_back(street.at_m.back() + step);
          street.line.push_back(p);
          if (degrees_[key] > 2 && n + 1 < way.lon_lat.size()) finish(key);
        }
      }
      if (run.street.line.empty()) {
        run.street.line.push_back(p);
        run.street.at_m.push_back(0);
        run.first = key;
      }
      last_key_ = key;
    }
    if (!run.street.line.empty()) finish(last_key_);
  }

  StreetNetwork build(Joining joining) {
    order(joining);
    if (joining == Joining::same_road) {
      join();
      order(joining);
    }
    StreetNetwork network;
    std::map<NodeKey, std::size_t> joints;
    for (Run& run : runs_) {
      const std::size_t index = network.streets.size();
      for (const bool at_start : {true, false}) {
        const auto [joint, is_new] =
            joints.try_emplace(at_start ? run.first : run.last, network.joints.size());
        if (is_new)
          network.joints.push_back(
              {at_start ? run.street.line.front() : run.street.line.back(), {}});
        network.joints[joint->second].ends.push_back({index, at_start});
        run.street.joints[at_start ? 0 : 1] = joint->second;
      }
      network.streets.push_back(std::move(run.street));
    }
    return network;
  }

 private:
  /// Sorts the runs, so that the order of the ways and their ids decide nothing. Where streets are
  /// joined, neither do their directions.
  void order(Joining joining) {
    if (joining == Joining::same_road)
      for (Run& run : runs_)
        if (runs_back(run.street.line)) reverse(run);
    std::stable_sort(runs_.begin(), runs_.end(), comes_first);
  }

  /// Joins two runs of one road if nothing else meets them at their common end.
  void join() {
    std::map<NodeKey, std::vector<std::size_t>> ends;
    joined_.assign(runs_.size(), false);
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      ends[runs_[r].first].push_back(r);
      ends[runs_[r].last].push_back(r);
    }
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      if (joined_[r]) continue;
      for (int side = 0; side < 2; ++side) {  // grow at the end, reverse, grow at the other end
        grow(r, ends);
        reverse(runs_[r]);
      }
    }
    std::size_t n = 0;
    std::erase_if(runs_, [&](const Run&) { return joined_[n++]; });
  }

  void grow(std::size_t r, const std::map<NodeKey, std::vector<std::size_t>>& ends) {
    while (runs_[r].first != runs_[r].last) {
      const auto& here = ends.at(runs_[r].last);
      if (here.size() != 2) return;
      // Find the other of the two. Runs joined to r earlier still have their old number here.
      std::size_t next = runs_.size();
      for (const std::size_t candidate : here)
        if (candidate != r && !joined_[candidate]) next = candidate;
      if (next == runs_.size() || !same_road(runs_[r].street.road, runs_[next].street.road)) return;
      if (runs_[next].first != runs_[r].last) reverse(runs_[next]);
      append(runs_[r], runs_[next]);
      joined_[next] = true;
    }
  }

  std::map<NodeKey, int> degrees_;
  std::vector<Run> runs_;
  std::vector<bool> joined_;
  NodeKey last_key_;
};

}  // namespace

Street::Place Street::place(double s) const {
  s = std::clamp(s, 0.0, length_m());
  const auto above = std::upper_bound(at_m.begin() + 1, at_m.end() - 1, s);
  const auto n = static_cast<std::size_t>(above - at_m.begin()) - 1;
  const double t = (s - at_m[n]) / (at_m[n + 1] - at_m[n]);
  const Piece& piece = pieces[n];
  return {glm::mix(line[n], line[n + 1], t), glm::normalize(line[n + 1] - line[n]), piece.way_id,
          piece.from_m + t * (piece.to_m - piece.from_m)};
}

StreetNetwork make_street_network(const std::vector<const osm::OsmWay*>& ways,
                                  const std::function<glm::dvec2(const glm::dvec2&)>& to_frame,
                                  Joining joining) {
  NetworkBuilder builder;
  for (const osm::OsmWay* way : ways)
    if (roads::read_carriageway(way->tags)) builder.count(*way);
  for (const osm::OsmWay* way : ways)
    if (const auto road = roads::read_carriageway(way->tags)) builder.cut(*way, *road, to_frame);
  return builder.build(joining);
}

}  // namespace nightcity::streets
