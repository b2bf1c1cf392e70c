// Scatter plots with logarithmic axes, as SVG.
#pragma once

#include <string>
#include <vector>

namespace nightcity::measure {

struct PlotPoint {
  double x, y;        // left out of the plot unless positive and finite
  std::string label;  // shown when the pointer rests on it
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  // joined by a line in this order
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotSeries> series;
};

/// Returns an SVG of 760 x 480: axes with 1-2-5 ticks, one colour per series, a legend.
std::string to_svg(const Plot& plot);

}  // namespace nightcity::measure
