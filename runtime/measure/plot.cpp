#include "runtime/measure/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nightcity::measure {
namespace {

constexpr double width = 760, height = 480, left = 80, right = 600, top = 40, bottom = 420;

// Okabe and Ito's palette, which people with colour vision deficiencies can distinguish.
constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                             "#E69F00", "#56B4E9", "#000000", "#999999"};

bool shown(const PlotPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y > 0;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

struct Axis {
  double low = 1, high = 10;  // values at `from` and `to`
  double from, to;            // pixels

  double operator()(double value) const {
    return from + (to - from) * (std::log10(value) - std::log10(low)) /
                      (std::log10(high) - std::log10(low));
  }
  std::vector<double> ticks() const {
    std::vector<double> values;
    for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
      for (const double step : {1.0, 2.0, 5.0})
        if (step * decade >= low * 0.999 && step * decade <= high * 1.001)
          values.push_back(step * decade);
    return values;
  }
};

Axis fitted(const Plot& plot, double PlotPoint::*value, double from, double to) {
  Axis axis{1, 10, from, to};
  bool first = true;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) {
      if (!shown(point)) continue;
      axis.low = first ? point.*value : std::min(axis.low, point.*value);
      axis.high = first ? point.*value : std::max(axis.high, point.*value);
      first = false;
    }
  axis.low *= 0.85;
  axis.high = std::max(axis.high * 1.15, axis.low * 2);
  return axis;
}

}  // namespace

std::string to_svg(const Plot& plot) {
  const Axis x = fitted(plot, &PlotPoint::x, left, right),
             y = fitted(plot, &PlotPoint::y, bottom, top);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"24\" font-size=\"14\">{3}</text>\n",
      width, height, left, escaped(plot.title));
  for (const double tick : x.ticks())
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/>"
        "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
        x(tick), top, bottom, bottom + 18, tick);
  for (const double tick : y.ticks())
    svg += fmt::format(
        "<line x1=\"{1}\" y1=\"{0:.1f}\" x2=\"{2}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/>"
        "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>\n",
        y(tick), left, right, left - 6, y(tick) + 4, tick);
  svg += fmt::format(
      "<rect x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" fill=\"none\" stroke=\"black\"/>\n"
      "<text x=\"{4}\" y=\"{5}\" text-anchor=\"middle\">{6}</text>\n"
      "<text transform=\"translate(20,{7}) rotate(-90)\" text-anchor=\"middle\">{8}</text>\n",
      left, top, right - left, bottom - top, (left + right) / 2, height - 16, escaped(plot.x_label),
      (top + bottom) / 2, escaped(plot.y_label));
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const char* colour = colours[i % colours.size()];
    std::string line, dots;
    for (const PlotPoint& point : plot.series[i].points) {
      if (!shown(point)) continue;
      line += fmt::format("{:.1f},{:.1f} ", x(point.x), y(point.y));
      dots += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"><title>{}</title></circle>\n",
          x(point.x), y(point.y), colour, escaped(point.label));
    }
    const double legend = top + 14 + 18 * double(i);
    svg += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-opacity=\"0.5\"/>\n{}", line,
        colour, dots);
    svg += fmt::format(
        "<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
        right + 14, legend - 4, colour, right + 24, legend, escaped(plot.series[i].name));
  }
  return svg + "</svg>\n";
}

}  // namespace nightcity::measure
