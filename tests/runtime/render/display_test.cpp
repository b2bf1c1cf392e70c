// Pictures as they are looked at: the glare of one bright pixel against the point spread function,
// mesopic colours against the standard's equations, and both the same in files and in the window.
#include "runtime/render/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "formats/colour.h"
#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/render/glare.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::render {
namespace {

constexpr double pixel_rad = 5e-4;  // 0.029 degrees: 1,920 pixels for 55 degrees

measure::Image even_picture(std::uint32_t side, const glm::vec3& light) {
  measure::Image image{side, side, {}, {}, {}};
  for (std::size_t i = 0; i < image.pixels(); ++i)
    image.rgb.insert(image.rgb.end(), {light.r, light.g, light.b});
  return image;
}

// Returns the light of a code value of the linear curve, exposed as in `display`.
double decode(std::uint8_t code, const DisplaySettings& display) {
  const double x = code / 255.0;
  const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  return linear / double{tonemap::exposure_scale(display.ev100)};
}

// Exposes so that `light` lies in the middle of the linear curve.
DisplaySettings exposed_for(double light, DisplaySettings display) {
  display.tone = TONEMAP_LINEAR;
  display.ev100 = float(std::log2(light / 0.6));
  return display;
}

measure::Image8 develop(const measure::Image& image, const DisplaySettings& display) {
  Display shown(test::test_device(), test::test_passes());
  return shown.develop(image, display, pixel_rad);
}

std::uint8_t green(const measure::Image8& picture, std::uint32_t x, std::uint32_t y) {
  return picture.rgb[3 * (std::size_t{y} * picture.width + x) + 1];
}

// The pyramid's sum follows the function within 7 % in the mean over a ring and within 23 % at a
// pixel, wherever the bright pixel lies; the rest is what 8 bits tell apart.
TEST(Display, OneBrightPixelIsSpreadAsTheEyeScatters) {
  constexpr std::uint32_t side = 257;
  constexpr float luminance = 1e6f;
  for (const std::uint32_t middle : {128u, 131u}) {
    measure::Image image = even_picture(side, glm::vec3(0));
    image.rgb[3 * (std::size_t{middle} * side + middle) + 1] = luminance;
    for (const int radius : {8, 12, 16, 24, 32, 48, 64}) {
      const auto expected_at = [&](double pixels) {
        return double{luminance} * pixel_rad * pixel_rad *
               glare_at(pixels * pixel_rad * 180 / M_PI, 30);
      };
      const DisplaySettings display = exposed_for(expected_at(radius), {.glare_age = 30});
      const measure::Image8 picture = develop(image, display);
      double ours = 0, expected = 0;
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
          const double r = std::hypot(double(x) - middle, double(y) - middle);
          if (std::abs(r - radius) > 0.05 * radius) continue;
          const double light = decode(green(picture, x, y), display), truth = expected_at(r);
          EXPECT_NEAR(light / truth, 1, 0.23) << r;
          ours += light;
          expected += truth;
        }
      EXPECT_NEAR(ours / expected, 1, 0.07) << radius << " of " << middle;
    }
  }
}

// Light that goes to a pixel's neighbours comes from them, too: an even picture stays as it is but
// for what leaves it and what comes from outside.
TEST(Display, GlareKeepsAnEvenPictureInItsMiddle) {
  const measure::Image image = even_picture(513, glm::vec3(0.4f));
  const DisplaySettings display = exposed_for(0.4, {.glare_age = 30});
  const measure::Image8 picture = develop(image, display);
  const double middle = decode(green(picture, 256, 256), display),
               corner = decode(green(picture, 0, 0), display);
  EXPECT_LE(middle, 0.4 * 1.01);
  EXPECT_GT(middle, 0.4 * 0.93);
  EXPECT_LT(corner, middle);
  EXPECT_GT(corner, 0.4 * 0.4);
}

TEST(Display, GlareOfPicturesOfAnySizeIsFinite) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {2u, 1u}, {1u, 300u}, {5u, 3u}}) {
    measure::Image image{width, height, {}, {}, {}};
    image.rgb.assign(3 * image.pixels(), 1);
    const DisplaySettings display = exposed_for(1, {.glare_age = 60});
    const measure::Image8 picture = develop(image, display);
    for (const std::uint8_t code : picture.rgb) {
      EXPECT_GT(code, 20);
      EXPECT_LE(decode(code, display), 1.02);
    }
  }
}

// A value that is not finite would be spread over the whole picture.
TEST(Display, GlareSpreadsNoNaN) {
  measure::Image image = even_picture(64, glm::vec3(1));
  image.rgb[3 * 1000] = std::numeric_limits<float>::quiet_NaN();
  image.rgb[3 * 1001] = std::numeric_limits<float>::infinity();
  const DisplaySettings display = exposed_for(1, {.glare_age = 30});
  const measure::Image8 picture = develop(image, display);
  for (std::size_t i = 0; i < image.pixels(); ++i)
    EXPECT_NEAR(picture.rgb[3 * i], picture.rgb[3 * i + 1], i == 1000 || i == 1001 ? 255 : 30);
}

TEST(Display, WithoutAnEyeIsTheCurveOfMeasurements) {
  std::mt19937 random(3);
  measure::Image image = even_picture(32, glm::vec3(0));
  for (float& value : image.rgb) value = std::exp2(float(random() % 2000) / 100 - 10);
  const measure::Image8 plain = measure::to_display(image, 1, TONEMAP_FILMIC);
  EXPECT_EQ(develop(image, {.ev100 = 1}).rgb, plain.rgb);
  // In bright light, cones alone see.
  for (float& value : image.rgb) value += 20;
  const measure::Image8 bright = measure::to_display(image, 5, TONEMAP_FILMIC),
                        seen = develop(image, {.ev100 = 5, .mesopic = true});
  for (std::size_t i = 0; i < seen.rgb.size(); ++i) EXPECT_NEAR(seen.rgb[i], bright.rgb[i], 1);
}

TEST(Display, ShowsTheLightOfTheWhiteBalanceAsGrey) {
  const measure::Image image = even_picture(8, 0.5f * rec709_from_xy(planckian_xy(3000)));
  const measure::Image8 brown = develop(image, exposed_for(0.5, {})),
                        grey = develop(image, exposed_for(0.5, {.white_balance_k = 3000}));
  EXPECT_GT(brown.rgb[0], brown.rgb[2] + 60);
  EXPECT_NEAR(grey.rgb[0], grey.rgb[2], 1);
  EXPECT_NEAR(grey.rgb[0], grey.rgb[1], 1);
}

// The equations of CIE 191:2010 (MES2), solved by bisection.
double mesopic_luminance(double photopic, double scotopic, double& m) {
  const double rods = 683.0 / 1699;
  const auto luminance = [&](double share) {
    return (share * photopic + (1 - share) * scotopic * rods) / (share + (1 - share) * rods);
  };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    m = (low + high) / 2;
    const double next = 0.7670 + 0.3334 * std::log10(luminance(m));
    (next > m ? low : high) = m;
  }
  return luminance(m);
}

TEST(Display, MesopicColoursFollowTheStandard) {
  for (const double photopic : {0.01, 0.1, 1.0})
    for (const double kelvin : {2000.0, 6500.0}) {
      const glm::dvec3 rgb = photopic * glm::dvec3(rec709_from_xy(planckian_xy(kelvin)));
      const double x = 0.4124 * rgb.r + 0.3576 * rgb.g + 0.1805 * rgb.b,
                   z = 0.0193 * rgb.r + 0.1192 * rgb.g + 0.9505 * rgb.b;
      const double scotopic = photopic * (1.33 * (1 + (photopic + z) / x) - 1.68);
      double m = 0;
      const double mesopic = mesopic_luminance(photopic, scotopic, m);
      const DisplaySettings display = exposed_for(photopic, {.mesopic = true});
      const measure::Image8 picture = develop(even_picture(4, glm::vec3(rgb)), display);
      const double rods[] = {1.05, 0.97, 1.27};
      for (unsigned c = 0; c < 3; ++c) {
        const double expected = m * rgb[int(c)] + (1 - m) * mesopic * rods[c];
        if (expected > 0.95 * photopic / 0.6) continue;  // white
        EXPECT_NEAR(decode(picture.rgb[c], display), expected, 0.02 * photopic)
            << photopic << " cd/m2, " << kelvin << " K, channel " << c;
      }
    }
}

// The window and a file show one picture.
TEST(Display, TheWindowAndAFileShowTheSame) {
  const scene::RenderScene scene =
      test::boxes_on_a_plane().with({test::lamp({0, 6, 4}, 4000, 0.1f)});
  DeviceScene on_device(test::test_device(), scene);
  Renderer renderer(test::test_device(), test::test_passes(), on_device, 61, 37);
  RenderSettings settings;
  renderer.render_frame({{-9, 10, 17}, {0, 1, 0}, {0, 1, 0}, 50}, settings);
  DisplaySettings display{.ev100 = 0, .glare_age = 40, .adapt_white = true, .mesopic = true};
  display.adapted_to = {0.4f, 0.3f, 0.1f};
  renderer.expose(display);
  const auto words = renderer.display().read<std::uint32_t>(61 * 37);
  const measure::Image8 file = renderer.develop(renderer.download(false), display);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < words.size(); ++i)
    for (unsigned c = 0; c < 3; ++c) {
      EXPECT_NEAR(int(words[i] >> 8 * c & 255), int{file.rgb[3 * i + c]}, 1);
      lit += file.rgb[3 * i + c] > 20;
    }
  EXPECT_GT(lit, 1000u);
}

TEST(Display, GlareIsRefusedInOtherProjections) {
  const scene::RenderScene scene = test::boxes_on_a_plane().with({});
  DeviceScene on_device(test::test_device(), scene);
  Renderer renderer(test::test_device(), test::test_passes(), on_device, 8, 8);
  RenderSettings settings;
  settings.display.glare_age = 30;
  settings.projection = PROJECTION_FISHEYE;
  EXPECT_THROW(renderer.render_frame({{0, 5, 9}, {0, 0, 0}, {0, 1, 0}, 50}, settings), UsageError);
}

TEST(Display, SaysWhatItAdds) {
  EXPECT_EQ(describe_eye({}), "");
  EXPECT_FALSE(has_eye({}));
  EXPECT_EQ(describe_eye({.glare_age = 30, .white_balance_k = 3200, .mesopic = true}),
            "glare of an eye of 30 years, white of 3200 K, mesopic colours");
  EXPECT_EQ(describe_eye({.adapt_white = true}), "white adapted to the scene");
}

}  // namespace
}  // namespace nightcity::render
