#include "tools/traffic/road_graph.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "tools/streets/street_network.h"
#include "tools/traffic/clip_ways.h"

namespace nightcity::traffic {
namespace {

constexpr double ground_step_m = 20;   // between samples of the ground below a way
constexpr double building_step_m = 3;  // between samples of buildings on a way
constexpr double shortest_m = 1.0;  // a shorter street holds no vehicle: its ends become one node

bool runs_through_building(const RoadEdge& edge, const place::InsideBuilding& inside) {
  if (!inside || edge.structure) return false;
  for (std::size_t n = 0; n + 1 < edge.line.size(); ++n) {
    const glm::dvec2 step = edge.line[n + 1] - edge.line[n];
    const double length = glm::length(step);
    const glm::dvec2 right = glm::dvec2(step.y, -step.x) / length;
    const int looks = std::max(1, static_cast<int>(std::ceil(length / building_step_m)));
    // Check where vehicles drive, without the outermost half metre: maps are no more exact than
    // that.
    const double reach = std::max(0.0, edge.half_width_m - 0.5);
    for (int k = 0; k <= looks; ++k)
      for (const double side : {-reach, 0.0, reach})
        if (inside(edge.line[n] + step * (static_cast<double>(k) / looks) +
                   right * (edge.middle_m + side)))
          return true;
  }
  return false;
}

class GraphBuilder {
 public:
  GraphBuilder(const place::HeightAt& height_at, const place::InsideBuilding& inside)
      : height_at_(height_at), inside_(inside) {}

  void add_streets(const streets::StreetNetwork& network,
                   const std::unordered_map<std::int64_t, Drivable>& drivable) {
    graph.nodes.resize(network.joints.size());
    for (std::size_t n = 0; n < network.joints.size(); ++n)
      graph.nodes[n].place = network.joints[n].point;
    for (const streets::Street& street : network.streets) {
      const std::int64_t way = street.pieces.front().way_id;
      add_street(street, drivable.at(way), way);
    }
  }

  void add_street(const streets::Street& street, const Drivable& way, std::int64_t way_id) {
    if (street.length_m() < shortest_m && street.joints[0] == street.joints[1]) return;
    RoadEdge along;
    along.from = street.joints[0];
    along.to = street.joints[1];
    along.line = street.line;
    along.length_m = street.length_m();
    const roads::Carriageway& carriageway = way.carriageway;
    along.road = carriageway.road_class;
    along.traffic = way.traffic;
    along.lane_m = carriageway.lane_m();
    along.half_width_m = along.lane_m * (carriageway.lanes[0] + carriageway.lanes[1]) / 2;
    along.middle_m = -carriageway.lanes_left_m();
    along.one_way = !way.both_ways();
    along.roundabout = carriageway.roundabout;
    along.structure = way.structure;
    along.bridge = way.bridge;
    along.way_id = way_id;
    along.name = street.name;
    if (runs_through_building(along, inside_)) {
      ++graph.left_out["stretch through a building"];
      return;
    }
    ++graph.nodes[along.from].streets;
    ++graph.nodes[along.to].streets;
    RoadEdge against = along;
    std::swap(against.from, against.to);
    std::reverse(against.line.begin(), against.line.end());
    against.middle_m = -along.middle_m;
    std::size_t numbers[2] = {none, none};
    for (std::size_t d = 0; d < 2; ++d) {
      if (carriageway.lanes[d] == 0) continue;
      RoadEdge& edge = d == 0 ? along : against;
      edge.lanes = carriageway.lanes[d];
      edge.speed_m_s = way.speed_m_s[d];
      numbers[d] = graph.edges.size();
      graph.nodes[edge.from].out.push_back(numbers[d]);
      graph.nodes[edge.to].in.push_back(numbers[d]);
      graph.edges.push_back(std::move(edge));
    }
    for (std::size_t d = 0; d < 2; ++d)
      if (numbers[d] != none) graph.edges[numbers[d]].opposite = numbers[1 - d];
  }

  /// Nodes get the height of the ground. Nodes inside a bridge or tunnel get heights between those
  /// of its ends, as in a network of resistors whose conductance is 1 / length.
  void find_heights() {
    std::vector<bool> hung(graph.nodes.size(), false);
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
      RoadNode& node = graph.nodes[n];
      hung[n] = node.streets > 1;
      for (const auto* edges : {&node.in, &node.out})
        for (const std::size_t e : *edges) hung[n] = hung[n] && graph.edges[e].structure;
      node.height_m = height_at_(node.place).value_or(0);
    }
    for (int round = 0; round < 200; ++round) {
      double change = 0;
      for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if (!hung[n]) continue;
        double sum = 0, weight = 0;
        const auto pull = [&](std::size_t other, double length) {
          sum += graph.nodes[other].height_m / length;
          weight += 1 / length;
        };
        for (const std::size_t e : graph.nodes[n].in)
          pull(graph.edges[e].from, graph.edges[e].length_m);
        for (const std::size_t e : graph.nodes[n].out)
          pull(graph.edges[e].to, graph.edges[e].length_m);
        if (weight == 0) continue;
        change = std::max(change, std::abs(sum / weight - graph.nodes[n].height_m));
        graph.nodes[n].height_m = sum / weight;
      }
      if (change < 1e-3) break;
    }
  }

  RoadGraph graph;

 private:
  const place::HeightAt& height_at_;
  const place::InsideBuilding& inside_;
};

/// Marks the dead ends at which the map ends, not the street: streets that were cut off, and
/// streets too important to end in a field.
void mark_borders(RoadGraph& graph, const std::vector<bool>& was_cut) {
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    RoadNode& node = graph.nodes[n];
    if (node.streets != 1) continue;
    const std::size_t edge = node.out.empty() ? node.in.front() : node.out.front();
    node.border = was_cut[n] || graph.edges[edge].road->rank >= 5;
  }
}

// Returns one country for the whole map, as no town drives on both sides: that of most nodes, of
// two the one whose name comes first. Null where no way has a node.
const Country* find_country(const std::vector<osm::OsmWay>& highways) {
  std::map<std::string_view, std::pair<std::size_t, const Country*>> votes;
  for (const osm::OsmWay& way : highways)
    for (const glm::dvec2& lon_lat : way.lon_lat) {
      const Country& country = country_at(lon_lat);
      auto& [count, one] = votes[country.name];
      ++count;
      one = &country;
    }
  const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
    return a.second.first < b.second.first;
  });
  return most == votes.end() ? nullptr : most->second.second;
}

}  // namespace

glm::dvec2 find_start_direction(const RoadEdge& edge) {
  return glm::normalize(edge.line[1] - edge.line[0]);
}

glm::dvec2 find_end_direction(const RoadEdge& edge) {
  return glm::normalize(edge.line.back() - edge.line[edge.line.size() - 2]);
}

double RoadEdge::lane_offset(int lane, Side side) const {
  const double to_kerb = half_width_m - (lane + 0.5) * lane_m;
  return middle_m + (side == Side::right ? to_kerb : -to_kerb);
}

double RoadGraph::lane_km() const {
  double sum = 0;
  for (const RoadEdge& edge : edges) sum += edge.length_m * edge.lanes;
  return sum / 1000;
}

RoadGraph make_road_graph(const std::vector<osm::OsmWay>& highways,
                          const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
                          const place::InsideBuilding& inside, std::optional<Side> side) {
  GraphBuilder builder(height_at, inside);
  const Country* const country = find_country(highways);
  std::unordered_map<std::int64_t, Drivable> drivable;
  ClippedWays clipped;
  for (const osm::OsmWay& way : highways) {
    if (way.lon_lat.empty()) continue;
    std::string why;
    const auto read = read_drivable(way, *country, why);
    if (!read) {
      ++builder.graph.left_out[why];
      continue;
    }
    const std::size_t before = clipped.ways.size();
    clip_way(way, to_frame, height_at, ground_step_m, clipped);
    if (clipped.ways.size() == before)
      ++builder.graph.left_out["outside the model"];
    else
      drivable[way.id] = *read;
  }
  if (country) {
    builder.graph.side = side.value_or(country->side);
    builder.graph.country = country->name;
  }

  std::vector<const osm::OsmWay*> pointers;
  for (const osm::OsmWay& way : clipped.ways) pointers.push_back(&way);
  const streets::StreetNetwork network =
      streets::make_street_network(pointers, to_frame, streets::Joining::never);
  builder.add_streets(network, drivable);

  std::vector<bool> was_cut(network.joints.size(), false);
  std::set<std::pair<std::int64_t, std::int64_t>> cut_places;
  for (const osm::OsmWay& way : clipped.ways)
    for (const glm::dvec2& end : {way.lon_lat.front(), way.lon_lat.back()})
      if (clipped.cuts.contains(osm_units(end))) {
        const glm::dvec2 p = to_frame(end);
        cut_places.insert({std::llround(p.x * 100), std::llround(p.y * 100)});
      }
  for (std::size_t n = 0; n < network.joints.size(); ++n) {
    const glm::dvec2 p = network.joints[n].point;
    was_cut[n] = cut_places.contains({std::llround(p.x * 100), std::llround(p.y * 100)});
  }
  mark_borders(builder.graph, was_cut);
  builder.find_heights();
  return std::move(builder.graph);
}

}  // namespace nightcity::traffic
