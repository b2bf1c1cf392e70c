// The barriers of a map as lines and areas on the ground: walls, hedges, fences, guard rails.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "tools/barriers/barrier_ends.h"
#include "tools/barriers/barrier_kind.h"
#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::barriers {

/// A barrier, or what is left of one between its openings: its middle line on the ground.
struct BarrierLine {
  BarrierKind kind;
  std::vector<glm::dvec3> points;  // E, N, H of the city's frame, m
  bool closed = false;             // the last point is joined to the first
  BarrierEnd ends[2] = {};         // of thick ones: at the first and the last point
};

/// A hedge or a wall as wide as its outline says.
struct BarrierArea {
  BarrierKind kind;
  std::vector<glm::dvec3> points;                       // on the ground; E, N, H, m
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise in plan
};

struct BarrierReport {
  struct Kind {
    std::size_t ways = 0;
    double mapped_m = 0, built_m = 0;  // length; of an area its outline's
  };
  std::map<std::string, Kind> kinds;         // by the value of `barrier`, where it is a known one
  std::map<std::string, double> left_out_m;  // by reason: mapped less built
  std::map<std::string, std::size_t> assumed;
  std::size_t openings = 0, areas = 0;
};

struct BarrierSet {
  std::vector<BarrierLine> lines;
  std::vector<BarrierArea> areas;
  BarrierReport report;
};

/// Longer barriers together are left out, and counted, m.
constexpr double max_length_m = 4e6;

/// Finds the barriers that stand on the ground within `bounds` (E, N, m): neither in buildings nor
/// on the carriageways of `cover`, which both sides of thick ones end at, and open at gates and
/// where a path meets them. Of several barriers along one line the most solid stands.
BarrierSet find_barriers(const osm::OsmData& map, const ground_cover::Cover& cover,
                         const ground_cover::Box& bounds, const place::LonLatToFrame& to_frame,
                         const place::HeightAt& height_at, const place::InsideBuilding& inside);

}  // namespace nightcity::barriers
