#include "runtime/measure/model_difference.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity::measure {
namespace {

constexpr std::size_t min_pairs = 3;  // the jackknife leaves one out, and a product needs two

// Values of one picture after a conversion, channel by channel.
using Values = std::vector<float>;

Values to_display_values(const Image& image, float ev100) {
  const float scale = tonemap::exposure_scale(ev100);
  Values values(image.rgb.size());
  std::transform(image.rgb.begin(), image.rgb.end(), values.begin(), [scale](float value) {
    const float code = tonemap::srgb_encode(tonemap::tone_curve(TONEMAP_FILMIC, value * scale));
    return 255.0f * std::min(code, 1.0f);
  });
  return values;
}

double mean_luminance(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const float* rgb = &image.rgb[3 * i];
    sum += double{tonemap::luminance_709(rgb[0], rgb[1], rgb[2])};
  }
  return sum / double(image.pixels());
}

// Returns the estimate of an estimator with all pairs and its standard error, from the values that
// it has without each of them.
Estimate jackknife(double with_all, const std::vector<double>& without_one) {
  const double n = double(without_one.size());
  double mean = 0, squares = 0;
  for (const double value : without_one) mean += value / n;
  for (const double value : without_one) squares += (value - mean) * (value - mean);
  return {with_all, std::sqrt(squares * (n - 1) / n)};
}

// Returns the mean over values of weight * (E[a] - E[b])^2, where a[i] and b[i] are those of pair
// i.
Estimate find_square(const std::vector<Values>& a, const std::vector<Values>& b,
                     const std::vector<double>& weights) {
  const std::size_t pairs = a.size(), count = weights.size();
  // Sums over values of weight * D_i D_j, i != j: of all, and of those with pair k.
  double all = 0;
  std::vector<double> with(pairs);
  std::vector<double> d(pairs);
  for (std::size_t v = 0; v < count; ++v) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
      d[i] = double{a[i][v]} - double{b[i][v]};
      sum += d[i];
      squares += d[i] * d[i];
    }
    all += weights[v] * (sum * sum - squares);
    for (std::size_t i = 0; i < pairs; ++i) with[i] += weights[v] * 2 * d[i] * (sum - d[i]);
  }
  const double n = double(pairs), values = double(count);
  std::vector<double> without_one;
  for (const double part : with) without_one.push_back((all - part) / ((n - 1) * (n - 2) * values));
  return jackknife(all / (n * (n - 1) * values), without_one);
}

// Returns the difference of the means of luminance, relative to that of B.
Estimate find_relative_mean(const std::vector<double>& a, const std::vector<double>& b) {
  double sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i];
    sum_b += b[i];
  }
  std::vector<double> without_one;
  for (std::size_t i = 0; i < a.size(); ++i)
    without_one.push_back((sum_a - a[i]) / (sum_b - b[i]) - 1);
  return jackknife(sum_a / sum_b - 1, without_one);
}

// Returns 1 / (b^2 + eps) of every value of the mean of `pictures`, as in Comparison::relative_mse.
std::vector<double> find_relative_weights(const std::vector<Values>& pictures) {
  std::vector<double> weights(pictures.front().size());
  double mean = 0;
  for (std::size_t v = 0; v < weights.size(); ++v) {
    for (const Values& picture : pictures)
      weights[v] += double{picture[v]} / double(pictures.size());
    mean += weights[v] / double(weights.size());
  }
  const double floor = 0.01 * mean * mean;
  for (double& weight : weights) weight = 1 / (weight * weight + floor);
  return weights;
}

void check(std::span<const Image> a, std::span<const Image> b) {
  if (a.size() != b.size() || a.size() < min_pairs)
    throw Error({}, "a difference without noise needs " + std::to_string(min_pairs) +
                        " pairs of pictures or more");
  for (const std::span<const Image>& side : {a, b})
    for (const Image& image : side) {
      if (image.pixels() == 0 || image.width != a[0].width || image.height != a[0].height)
        throw Error({}, "the pictures differ in size, or have no pixels");
      if (!std::all_of(image.rgb.begin(), image.rgb.end(),
                       [](float value) { return std::isfinite(value); }))
        throw Error({}, "a picture holds a value that is not a finite number");
    }
}

Image mean_of(std::span<const Image> pictures) {
  Image mean = pictures.front();
  mean.layers.clear();
  for (std::size_t v = 0; v < mean.rgb.size(); ++v) {
    double sum = 0;
    for (const Image& picture : pictures) sum += double{picture.rgb[v]};
    mean.rgb[v] = static_cast<float>(sum / double(pictures.size()));
  }
  return mean;
}

// Returns the pictures with their other pixels in one row.
std::vector<Image> keep_pixels(std::span<const Image> pictures, const std::vector<bool>& left_out) {
  std::vector<Image> kept;
  for (const Image& picture : pictures) {
    if (left_out.size() != picture.pixels())
      throw Error({}, "the pixels to be left out are those of another size");
    Image& row = kept.emplace_back();
    for (std::size_t i = 0; i < left_out.size(); ++i)
      if (!left_out[i])
        row.rgb.insert(row.rgb.end(), picture.rgb.begin() + std::ptrdiff_t(3 * i),
                       picture.rgb.begin() + std::ptrdiff_t(3 * i + 3));
    row.width = static_cast<std::uint32_t>(row.rgb.size() / 3);
    row.height = 1;
  }
  return kept;
}

}  // namespace

Estimate root_of(const Estimate& square) {
  const double root = std::sqrt(std::max(square.value, 0.0));
  // By the slope of the root, which has no bound at 0: there, the root of the error.
  return {root, std::min(root > 0 ? square.error / (2 * root) : std::sqrt(square.error),
                         std::sqrt(square.error))};
}

Estimate ModelDifference::rmse8() const {
  return root_of(mse8);
}

ModelDifference find_model_difference(std::span<const Image> a, std::span<const Image> b,
                                      std::optional<float> ev100,
                                      const std::vector<bool>& left_out) {
  check(a, b);
  if (std::find(left_out.begin(), left_out.end(), true) != left_out.end())
    return find_model_difference(keep_pixels(a, left_out), keep_pixels(b, left_out),
                                 ev100 ? *ev100 : auto_exposure_ev100(mean_of(b)));
  std::vector<double> means_a, means_b;
  std::vector<Values> values_a, values_b, shown_a, shown_b;
  ModelDifference result;
  result.ev100 = ev100 ? *ev100 : auto_exposure_ev100(mean_of(b));
  for (std::size_t i = 0; i < a.size(); ++i) {
    means_a.push_back(mean_luminance(a[i]));
    means_b.push_back(mean_luminance(b[i]));
    result.reference_mean += means_b.back() / double(a.size());
    values_a.push_back(a[i].rgb);
    values_b.push_back(b[i].rgb);
    shown_a.push_back(to_display_values(a[i], result.ev100));
    shown_b.push_back(to_display_values(b[i], result.ev100));
  }
  result.mse8 = find_square(shown_a, shown_b, std::vector<double>(a[0].rgb.size(), 1.0));
  if (!(result.reference_mean > 0)) {
    if (std::all_of(means_a.begin(), means_a.end(), [](double mean) { return mean == 0; }))
      return result;
    throw Error({}, "the reference is black, so there is no error relative to it");
  }
  result.relative_mean = find_relative_mean(means_a, means_b);
  result.relative_mse = find_square(values_a, values_b, find_relative_weights(values_b));
  return result;
}

}  // namespace nightcity::measure
