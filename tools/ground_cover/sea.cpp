#include "tools/ground_cover/sea.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "formats/finite.h"
#include "tools/ground_cover/clip_ring.h"
#include "tools/ground_cover/clip_segment.h"
#include "tools/ground_cover/closed_along_box.h"
#include "tools/ground_cover/join_lines.h"
#include "tools/ground_cover/way_line.h"
#include "tools/in_ring.h"
#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// Below all that the map says of land: a beach, a pier or a marina lies over the sea.
constexpr int sea_rank = 100;
// The water lies this far to the right of a coast. Coasts are drawn by the metre.
constexpr double beside_m = 0.01;
// The last node of a coast may lie as far from the edge of its map: an assumption.
constexpr double most_continued_m = 100;
// Bounds of the map are met in their inside and those of the ground outside, never on the line.
constexpr double map_margin_m = 0.001, ground_margin_m = 1.0471;

struct CoastPieces {
  std::vector<Line> across;  // from side to side of the box
  std::vector<Ring> closed;
  std::vector<Line> open;
};

// Returns the nearest place on a side of the box.
glm::dvec2 find_side(const glm::dvec2& p, const Box& box) {
  const std::array sides{glm::dvec2(box.low.x, p.y), glm::dvec2(box.high.x, p.y),
                         glm::dvec2(p.x, box.low.y), glm::dvec2(p.x, box.high.y)};
  return *std::min_element(sides.begin(), sides.end(), [&](const auto& a, const auto& b) {
    return glm::distance(a, p) < glm::distance(b, p);
  });
}

// Continues lines that end within `most_m` of a side of the box to that side. Returns how many.
std::size_t continue_to_sides(std::vector<Line>& lines, const Box& box, double most_m) {
  std::size_t count = 0;
  for (Line& line : lines) {
    if (line.size() > 3 && line.front() == line.back()) continue;
    for (int end = 0; end < 2; ++end) {
      const glm::dvec2 last = line.back(), side = find_side(last, box);
      if (box.holds(last) && glm::distance(last, side) <= most_m) {
        // Beyond the side, so that the line crosses it.
        line.push_back(side + (side - last));
        if (box.holds(line.back())) line.back() = side + (side - (box.low + box.high) * 0.5);
        ++count;
      }
      std::reverse(line.begin(), line.end());
    }
  }
  return count;
}

CoastPieces cut_coast(std::vector<Line> lines, const Box& box) {
  CoastPieces pieces;
  for (Line& line : lines) {
    const bool is_closed = line.size() > 3 && line.front() == line.back();
    const auto outside =
        std::find_if(line.begin(), line.end(), [&](const glm::dvec2& p) { return !box.holds(p); });
    if (is_closed && outside == line.end()) {
      line.pop_back();
      pieces.closed.push_back(std::move(line));
      continue;
    }
    if (is_closed) {  // begins where no piece does
      line.pop_back();
      std::rotate(line.begin(), outside, line.end());
      line.push_back(line.front());
    }
    for (Line& part : clip_line(line, box)) {
      const bool is_open = box.holds(line.front()) && part.front() == line.front();
      const bool ends_open = box.holds(line.back()) && part.back() == line.back();
      (is_open || ends_open ? pieces.open : pieces.across).push_back(std::move(part));
    }
  }
  return pieces;
}

bool is_water(const std::vector<std::pair<Box, const Ring*>>& rings, const glm::dvec2& place) {
  bool odd = false;
  for (const auto& [box, ring] : rings)
    if (box.holds(place) && in_ring(*ring, place)) odd = !odd;
  return odd;
}

std::vector<std::pair<Box, const Ring*>> with_boxes(const std::vector<Ring>& rings) {
  std::vector<std::pair<Box, const Ring*>> boxed;
  for (const Ring& ring : rings) boxed.emplace_back(find_box({ring}), &ring);
  return boxed;
}

struct RightSide {
  glm::dvec2 place;  // on the right of the longest piece of a way within the box
  double length_m = 0;
};

// Returns none where a way has nothing within the box, or where an open coast goes on.
std::optional<RightSide> find_right(const Line& way, const Box& box,
                                    const std::set<glm::dvec2, PointOrder>& open) {
  double longest = 0;
  RightSide side{{}, find_length_m(way, box)};
  for (std::size_t i = 1; i < way.size(); ++i) {
    const auto part = clip_segment(way[i - 1], way[i], box);
    if (!part) continue;
    if (open.contains(way[i - 1]) || open.contains(way[i])) return std::nullopt;
    const glm::dvec2 along = way[i] - way[i - 1];
    const double length = glm::length(along) * (part->second - part->first);
    if (!(length > longest)) continue;
    longest = length;
    side.place = way[i - 1] + along * ((part->first + part->second) / 2) +
                 glm::dvec2(along.y, -along.x) / glm::length(along) * beside_m;
  }
  return longest > 0 ? std::optional(side) : std::nullopt;
}

double sum_lengths_m(const std::vector<Line>& lines) {
  double length_m = 0;
  for (const Line& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) length_m += glm::distance(line[i - 1], line[i]);
  return length_m;
}

// Returns the rectangle that lies within the map's bounds and the ground's.
std::optional<Box> find_inner_box(const osm::LonLatBox& map, const place::LonLatToFrame& to_frame,
                                  const Box& bounds) {
  const std::array corners{to_frame(map.low), to_frame({map.high.x, map.low.y}), to_frame(map.high),
                           to_frame({map.low.x, map.high.y})};
  for (const glm::dvec2& corner : corners)
    if (!finite(corner)) return std::nullopt;
  const auto [sw, se, ne, nw] = corners;
  const glm::dvec2 margin(map_margin_m);
  const Box box{
      glm::max(bounds.low, glm::dvec2(std::max(sw.x, nw.x), std::max(sw.y, se.y)) + margin),
      glm::min(bounds.high, glm::dvec2(std::min(se.x, ne.x), std::min(nw.y, ne.y)) - margin)};
  return box.low.x < box.high.x && box.low.y < box.high.y ? std::optional(box) : std::nullopt;
}

// Adds rings in squares: an area of ten thousand islands would be asked about all of them wherever
// one of its places is looked up. There are at most 512 x 512, however far a ground reaches.
void add_squares(const std::vector<Ring>& rings, Cover& cover) {
  if (rings.empty()) return;
  const Box whole = find_box(rings);
  const glm::dvec2 size = whole.high - whole.low;
  double square_m = 128;
  while (square_m * 512 < std::max(size.x, size.y)) square_m *= 2;
  const auto find_row = [&](double at_m) { return static_cast<int>(std::floor(at_m / square_m)); };
  std::map<std::pair<int, int>, std::vector<Ring>> squares;
  for (const Ring& ring : rings) {
    const Box box = find_box({ring});
    for (int row = find_row(box.low.y); row <= find_row(box.high.y); ++row) {
      const double low_m = row * square_m;
      const Ring strip = clip_ring(ring, {box.low.x, low_m}, {box.high.x, low_m + square_m});
      if (strip.size() < 3) continue;
      const Box part = find_box({strip});
      for (int column = find_row(part.low.x); column <= find_row(part.high.x); ++column) {
        const double west_m = column * square_m;
        Ring piece = clip_ring(strip, {west_m, low_m}, {west_m + square_m, low_m + square_m});
        if (piece.size() >= 3) squares[{row, column}].push_back(std::move(piece));
      }
    }
  }
  for (auto& [at, pieces] : squares)
    cover.add({sea_rank, {GroundKind::water, false, false}, std::move(pieces)});
}

}  // namespace

Sea find_sea(const std::vector<Line>& ways, const Box& box, double continued_m) {
  Sea sea;
  std::vector<Line> lines = join_lines(ways);
  sea.continued = continue_to_sides(lines, box, continued_m);
  CoastPieces pieces = cut_coast(std::move(lines), box);
  std::set<glm::dvec2, PointOrder> open;
  for (const Line& line : pieces.open) open.insert(line.begin(), line.end());

  // One of two sets of rings is the sea, and the other one is the land.
  std::array<std::vector<Ring>, 2> sides = close_along_box(pieces.across, box);
  for (std::vector<Ring>& rings : sides)
    rings.insert(rings.end(), pieces.closed.begin(), pieces.closed.end());
  const auto first = with_boxes(sides[0]);
  std::array<double, 2> lengths_m{};
  std::array<std::size_t, 2> counts{};
  for (const Line& way : ways)
    if (const auto right = find_right(way, box, open)) {
      const std::size_t side = is_water(first, right->place) ? 0 : 1;
      lengths_m[side] += right->length_m;
      ++counts[side];
    }
  const std::size_t sea_side = lengths_m[0] > lengths_m[1] ? 0 : 1;
  sea.open_m = sum_lengths_m(pieces.open);
  sea.backward = counts[1 - sea_side];
  if (lengths_m[0] + lengths_m[1] > 0) sea.rings = std::move(sides[sea_side]);
  const auto water = with_boxes(sea.rings);
  const bool is_doubtful =
      std::any_of(pieces.open.begin(), pieces.open.end(),
                  [&](const Line& line) { return is_water(water, line[line.size() / 2]); });
  if (is_doubtful) {
    sea = {};
    sea.open_m = sum_lengths_m(pieces.open);
    sea.not_drawn_m = lengths_m[0] + lengths_m[1];
  }
  return sea;
}

void add_sea(std::span<const osm::OsmWay> ways, const std::optional<osm::LonLatBox>& map_bounds,
             const place::LonLatToFrame& to_frame, const Box& bounds, Cover& cover) {
  std::vector<Line> coast;
  for (const osm::OsmWay& way : ways)
    if (osm::find_tag(way.tags, "natural") == "coastline")
      if (Line line = find_line(way.lon_lat, to_frame, bounds); line.size() > 1)
        coast.push_back(std::move(line));
  if (coast.empty()) return;
  const glm::dvec2 margin(ground_margin_m);
  Sea sea = find_sea(coast, {bounds.low - margin, bounds.high + margin});
  // Complete ways reach beyond the bounds of an extract, but not always beyond the ground. Others
  // end at their last node within the bounds.
  const auto inner =
      sea.open_m > 0 && map_bounds ? find_inner_box(*map_bounds, to_frame, bounds) : std::nullopt;
  if (inner)
    if (Sea smaller = find_sea(coast, *inner, most_continued_m); smaller.open_m < sea.open_m)
      sea = std::move(smaller);
  if (sea.open_m > 0) cover.left_out_m["coastline that ends within the map"] += sea.open_m;
  if (sea.not_drawn_m > 0)
    cover.left_out_m["coastline whose sea is in doubt, as another one ends within the map"] +=
        sea.not_drawn_m;
  if (sea.continued > 0)
    cover.assumed["way of a coastline to the edge of its map"] += sea.continued;
  if (sea.backward > 0)
    cover.assumed["side of the sea at a coastline that contradicts the others"] += sea.backward;
  add_squares(sea.rings, cover);
}

}  // namespace nightcity::ground_cover
