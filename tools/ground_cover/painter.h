// The means to draw markings: strips along lines, and the places where streets meet.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {

/// Width of a crossing along the street, m: its bars are as long.
constexpr double crossing_m = 4;

/// Adds markings as far as they lie within bounds, until there are too many.
class Painter {
 public:
  Painter(const Box& bounds, Cover& cover) : bounds_(bounds), cover_(cover) {}
  bool is_done() const { return tried_ >= max_markings; }
  /// `name` says what it is, for the report.
  void add(const char* name, std::vector<glm::dvec2> strip);
  void leave_out(const char* reason) { ++cover_.left_out[reason]; }

 private:
  // A city of a million people has some 300,000 dashes. A hostile map gets no more than this.
  static constexpr std::size_t max_markings = 4'000'000;

  const Box& bounds_;
  Cover& cover_;
  std::size_t tried_ = 0;
};

/// A line with the distance of each point from its start. The line must outlive it.
class MeasuredLine {
 public:
  explicit MeasuredLine(const std::vector<glm::dvec2>& line);
  double length_m() const { return at_m_.back(); }
  double at(std::size_t i) const { return at_m_[i]; }

  /// Returns the corners of a strip from `from_m` to `to_m` along the line, between two distances
  /// to its left. A strip is straight: a bend within it becomes its chord.
  std::vector<glm::dvec2> make_strip(double from_m, double to_m, double right_m,
                                     double left_m) const;

 private:
  std::pair<glm::dvec2, glm::dvec2> find(double s) const;

  const std::vector<glm::dvec2>& line_;
  std::vector<double> at_m_;
};

/// Places where drivable ways meet, by their coordinates as written.
class Junctions {
 public:
  void add(const osm::OsmWay& way);
  bool holds(const glm::dvec2& lon_lat) const;

 private:
  std::map<std::pair<double, double>, int> arms_;
};

bool is_drivable(const std::optional<roads::Carriageway>& road);

}  // namespace nightcity::ground_cover
