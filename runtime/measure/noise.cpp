#include "runtime/measure/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "formats/error.h"

namespace nightcity::measure {
namespace {

constexpr std::array<std::string_view, 7> light_layers{
    "luminance", "direct_lamps", "direct_windows", "direct_vehicles", "sky", "emitted", "indirect"};

void average(std::vector<float>& values, const std::vector<float>& others) {
  if (values.size() != others.size()) throw Error({}, "the pictures differ in size");
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.5f * values[i] + 0.5f * others[i];
}

}  // namespace

double find_relative_noise(std::span<const Image> pictures) {
  if (pictures.size() < 2) throw Error({}, "noise is seen in two pictures or more");
  const std::size_t values = pictures[0].rgb.size();
  for (const Image& picture : pictures)
    if (picture.rgb.size() != values || values == 0)
      throw Error({}, "the pictures differ in size, or have no pixels");
  const double n = double(pictures.size());
  std::vector<double> means(values), variances(values);
  double mean = 0;
  for (std::size_t v = 0; v < values; ++v) {
    for (const Image& picture : pictures) means[v] += double{picture.rgb[v]} / n;
    for (const Image& picture : pictures)
      variances[v] +=
          (double{picture.rgb[v]} - means[v]) * (double{picture.rgb[v]} - means[v]) / (n - 1);
    mean += means[v] / double(values);
  }
  if (!(mean > 0)) return 0;
  double sum = 0;
  for (std::size_t v = 0; v < values; ++v)
    sum += variances[v] / (means[v] * means[v] + 0.01 * mean * mean);
  return std::sqrt(sum / double(values));
}

void average_light(Image& picture, const Image& other) {
  average(picture.rgb, other.rgb);
  for (ImageLayer& layer : picture.layers) {
    if (std::find(light_layers.begin(), light_layers.end(), layer.name) == light_layers.end())
      continue;
    if (const ImageLayer* same = other.layer(layer.name)) average(layer.values, same->values);
  }
  picture.info.frames += other.info.frames;
}

}  // namespace nightcity::measure
