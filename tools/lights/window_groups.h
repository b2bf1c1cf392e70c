// Windows taken together: one emitter for a storey's or a facade's lit windows in place of one
// each.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tools/lights/windows.h"

namespace nightcity::lights {

enum class WindowGrouping {
  none,
  storey,  // windows of a storey that lie in one wall
  facade   // windows of a wall
};

/// A group is at most this long, and as a facade this high, so that its light stays where it was.
constexpr double max_window_group_m = 20;

/// Takes windows in the order of their walls and passes on groups of them. A group is the smallest
/// upright rectangle round its windows and has the sum of their fluxes, spread evenly, and the mean
/// of their colour temperatures by flux. It has the hours and the id of one of its windows, drawn
/// by flux: at every moment of the night the expected flux of the group is that of its windows, and
/// a city's total is within the noise of the draw. Windows that have no other to go with pass as
/// they are. The result depends on the windows of the building alone.
class WindowGrouper {
 public:
  using Sink = std::function<void(const LitRectangle&)>;
  WindowGrouper(WindowGrouping grouping, Sink sink) : grouping_(grouping), sink_(std::move(sink)) {}

  void add(const LitRectangle& window);
  /// Passes on what waits; call it at the end.
  void finish();
  /// Returns the number of emitters that were passed on.
  std::size_t emitters() const { return emitters_; }

 private:
  // The extent of a rectangle in its wall, m: along it and upwards.
  struct Extent {
    double left, right, bottom, top;
  };
  struct Group {
    std::vector<LitRectangle> windows;
    Extent extent;
  };
  Extent extent_of(const LitRectangle& window) const;
  bool lies_in_wall(const LitRectangle& window) const;
  bool fits(const Group& group, const Extent& extent) const;
  void pass_on(const Group& group);

  WindowGrouping grouping_;
  Sink sink_;
  // Of the wall whose windows come at present. Places are from its first window.
  LitRectangle first_;
  std::vector<Group> groups_;
  std::size_t emitters_ = 0;
};

}  // namespace nightcity::lights
