// Draws markings.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/ground_cover/cover.h"

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

}  // namespace nightcity::ground_cover
