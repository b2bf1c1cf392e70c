#include "tools/citygml/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/citygml/tag_scanner.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {
namespace {

constexpr int max_curve_nesting = 20;
constexpr double chord_radians = 3 * std::numbers::pi / 180;

// Elements that only hold curves.
bool holds_curves(std::string_view local) {
  constexpr std::array names{std::string_view("curveMember"), std::string_view("curveMembers"),
                             std::string_view("Curve"),       std::string_view("segments"),
                             std::string_view("baseCurve"),   std::string_view("CompositeCurve"),
                             std::string_view("Ring")};
  return std::find(names.begin(), names.end(), local) != names.end();
}

// Returns the centre of the circle through three points, relative to `a`; none where they lie on
// one line, or so far apart that there is no number for it.
std::optional<glm::dvec3> find_centre(const glm::dvec3& a, const glm::dvec3& b,
                                      const glm::dvec3& c) {
  const glm::dvec3 u = b - a, v = c - a, normal = glm::cross(u, v);
  const double n = glm::dot(normal, normal), uu = glm::dot(u, u), vv = glm::dot(v, v);
  if (!(n > 1e-12 * uu * vv) || !std::isfinite(n)) return std::nullopt;
  const glm::dvec3 centre = (vv * glm::cross(normal, u) + uu * glm::cross(v, normal)) / (2 * n);
  // Squares of the radius are to be numbers too.
  return std::isfinite(glm::dot(centre, centre) * glm::dot(centre, centre)) ? std::optional(centre)
                                                                            : std::nullopt;
}

// Appends the arc from `a` through `b` to `c`, without `a`: chords on the circle through the three.
// `whole`: the arc goes on to `a`. Points on one line give two straight pieces.
void append_arc(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, bool whole,
                city::Ring& out) {
  const auto from_a = find_centre(a, b, c);
  if (!from_a) {
    out.insert(out.end(), {b, c});
    return;
  }
  // In this plane the arc runs counter-clockwise from the x axis.
  const glm::dvec3 centre = a + *from_a, x = -*from_a;
  const glm::dvec3 y = glm::cross(glm::normalize(glm::cross(b - a, c - a)), x);
  double sweep = std::atan2(glm::dot(c - centre, y), glm::dot(c - centre, x));
  if (sweep <= 0) sweep += 2 * std::numbers::pi;
  if (whole) sweep = 2 * std::numbers::pi;
  const int chords = std::max(2, static_cast<int>(std::ceil(sweep / chord_radians)));
  for (int i = 1; i < chords; ++i) {
    const double angle = sweep * i / chords;
    out.push_back(centre + std::cos(angle) * x + std::sin(angle) * y);
  }
  out.push_back(whole ? a : c);
}

// Turns the control points of an arc string (a, b, c, d, e: arcs abc and cde) into vertices.
RingFault stroke_arcs(const city::Ring& control, city::Ring& out) {
  if (control.size() < 3 || control.size() % 2 == 0) return RingFault::wrong_count;
  out.push_back(control.front());
  for (std::size_t i = 0; i + 2 < control.size(); i += 2)
    append_arc(control[i], control[i + 1], control[i + 2], false, out);
  return RingFault::none;
}

RingFault stroke_circle(const city::Ring& control, city::Ring& out) {
  if (control.size() != 3) return RingFault::wrong_count;
  if (!find_centre(control[0], control[1], control[2])) return RingFault::too_short;
  out.push_back(control[0]);
  append_arc(control[0], control[1], control[2], true, out);
  return RingFault::none;
}

RingFault read_curve(const pugi::xml_node& element, int dimension, int depth, city::Ring& out);

// Reads the curves below one after the other; what one ends with, the next begins with.
RingFault read_curves_below(const pugi::xml_node& element, int dimension, int depth,
                            city::Ring& out) {
  if (!element.first_child() && !find_attribute(element, "href").empty())
    return RingFault::unknown_curve;
  for (const pugi::xml_node& child : element.children()) {
    if (child.type() != pugi::node_element) continue;
    if (const RingFault fault = read_curve(child, dimension, depth + 1, out);
        fault != RingFault::none)
      return fault;
  }
  return RingFault::none;
}

RingFault read_curve(const pugi::xml_node& element, int inherited, int depth, city::Ring& out) {
  if (depth > max_curve_nesting) return RingFault::unknown_curve;
  const std::string_view name = local_name(element.name());
  const int dimension = find_dimension(element, inherited);
  if (name == "LineString" || name == "LineStringSegment")
    return read_vertices(element, dimension, out);
  if (name == "Arc" || name == "ArcString" || name == "Circle") {
    city::Ring control;
    if (const RingFault fault = read_vertices(element, dimension, control);
        fault != RingFault::none)
      return fault;
    return name == "Circle" ? stroke_circle(control, out) : stroke_arcs(control, out);
  }
  if (name == "OrientableCurve") {
    city::Ring piece;
    const RingFault fault = read_curves_below(element, dimension, depth, piece);
    if (find_attribute(element, "orientation") == "-") std::reverse(piece.begin(), piece.end());
    out.insert(out.end(), piece.begin(), piece.end());
    return fault;
  }
  if (holds_curves(name)) return read_curves_below(element, dimension, depth, out);
  return RingFault::unknown_curve;
}

}  // namespace

bool is_curve_ring(std::string_view local) {
  return local == "Ring";
}

RingFault read_curves(const pugi::xml_node& ring_element, int dimension, city::Ring& ring) {
  city::Ring points;
  const RingFault fault = read_curve(ring_element, dimension, 0, points);
  if (fault != RingFault::none) return fault;
  if (points.empty()) return RingFault::no_coordinates;
  for (const glm::dvec3& p : points)
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  return RingFault::none;
}

}  // namespace nightcity::citygml
