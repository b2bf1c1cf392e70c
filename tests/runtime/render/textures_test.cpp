// Pictures on surfaces: what a chequer reflects has a closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <string>

#include "formats/srgb.h"
#include "runtime/render/pass_constants.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/make_png.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

using Pixel = std::array<unsigned char, 3>;
constexpr int picture_side = 64, field_side = 8;  // texels of the picture, and of a field of it
constexpr float half_m = 20;
constexpr Pixel light_field{200, 120, 60}, dark_field{90, 90, 30};

bool is_light(int x, int y) {
  return (x / field_side + y / field_side) % 2 == 0;
}

double reflectance(const Pixel& pixel) {
  return 0.2126 * linear_from_srgb8(pixel[0]) + 0.7152 * linear_from_srgb8(pixel[1]) +
         0.0722 * linear_from_srgb8(pixel[2]);
}

// The ground under a chequer whose rows run to the south.
SceneBuilder chequered_ground(float repeats = 1) {
  SceneBuilder builder;
  builder.ground(half_m);
  const std::string png =
      make_rgb_png(picture_side, picture_side, [](std::size_t x, std::size_t y) {
        return is_light(static_cast<int>(x), static_cast<int>(y)) ? light_field : dark_field;
      });
  Scene& scene = builder.scene();
  const auto bytes = std::as_bytes(std::span(png));
  scene.pictures.emplace_back(bytes.begin(), bytes.end());
  scene.materials[0].base_colour = glm::vec3(0.9f);  // not what is under the picture
  scene.materials[0].texture.emplace();
  ScenePrimitive& ground = scene.meshes[0].primitives[0];
  for (const glm::vec3& p : ground.positions)
    ground.texture_coordinates.push_back(
        repeats * glm::vec2((p.x + half_m) / (2 * half_m), (p.z + half_m) / (2 * half_m)));
  return builder;
}

struct Texel {
  int x, y;
  bool is_inside;  // by a texel and a half of a field: nothing of its neighbours is mixed in
};
Texel texel_at(const std::vector<float>& points, std::size_t pixel) {
  const float x = (points[3 * pixel] + half_m) / (2 * half_m) * picture_side,
              y = (points[3 * pixel + 2] + half_m) / (2 * half_m) * picture_side;
  const auto within = [](float at) {
    const float in_field = std::fmod(at, float(field_side));
    return in_field > 1.5f && in_field < field_side - 1.5f;
  };
  return {static_cast<int>(x), static_cast<int>(y), within(x) && within(y)};
}

class TexturesByEveryEstimator : public testing::TestWithParam<render::EstimatorTraits> {};

// L = reflectance / pi * I cos(theta) / d^2, I = flux / (4 pi).
TEST_P(TexturesByEveryEstimator, AChequerReflectsEachOfItsTwoColours) {
  const double flux = 5000;
  const glm::dvec3 lamp_at(1.5, 8, -2);
  const scene::RenderScene scene = chequered_ground().with({lamp(glm::vec3(lamp_at), float(flux))});
  const bool noisy = GetParam().estimator == render::Estimator::basic;
  const measure::Image image = render(
      scene, looking_down, with_estimator(GetParam().estimator, 8, 30, 4), 96, 64, noisy ? 24 : 2);
  const std::vector<float>& points = image.layer("position")->values;
  const std::vector<float>& albedo = image.layer("albedo")->values;
  double sum[2] = {}, expected_sum[2] = {};
  int count[2] = {};
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const Texel texel = texel_at(points, i);
    if (!texel.is_inside) continue;
    const bool light = is_light(texel.x, texel.y);
    const Pixel& colour = light ? light_field : dark_field;
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_FLOAT_EQ(albedo[3 * i + c], float(linear_from_srgb8(colour[c]))) << "pixel " << i;
    const glm::dvec3 to = lamp_at - glm::dvec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    const double d2 = glm::dot(to, to);
    const double expected = reflectance(colour) / std::numbers::pi * flux / (4 * std::numbers::pi) *
                            (to.y / std::sqrt(d2)) / d2;
    if (!noisy) {
      ASSERT_NEAR(luminance(image, i), expected, 0.01 * expected) << "pixel " << i;
    }
    sum[light] += luminance(image, i);
    expected_sum[light] += expected;
    ++count[light];
  }
  for (const bool light : {false, true}) {
    EXPECT_GT(count[light], 500);
    EXPECT_NEAR(sum[light] / expected_sum[light], 1, 0.02);
  }
}
INSTANTIATE_TEST_SUITE_P(Every, TexturesByEveryEstimator,
                         testing::ValuesIn(render::list_estimators()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Textures, AFarChequerReflectsTheMeanOfItsColours) {
  // A repetition is 0.4 m wide, and a pixel 0.2 m or more.
  const scene::RenderScene scene = chequered_ground(100).with({lamp({0, 40, 0}, 5000)});
  scene::CameraPose pose = looking_down;
  pose.position.y = 300;
  pose.fov_deg = 5;
  const measure::Image image =
      render(scene, pose, with_estimator(render::Estimator::reference, 8, 30, 4), 48, 48, 16);
  const std::vector<float>& albedo = image.layer("albedo")->values;
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i)
    sum += 0.2126 * double(albedo[3 * i]) + 0.7152 * double(albedo[3 * i + 1]) +
           0.0722 * double(albedo[3 * i + 2]);
  EXPECT_NEAR(sum / double(image.pixels()),
              (reflectance(light_field) + reflectance(dark_field)) / 2, 0.03);
}

// Light that bounces off a chequer onto a white wall beside it, under an open sky: paths take the
// same mean of texels as the reference, wherever they come from.
TEST(Textures, BouncesOffAChequerAreThoseOfTheReference) {
  SceneBuilder builder = chequered_ground(3);
  Scene& plain = builder.scene();
  plain.materials.push_back({"white", glm::vec3(0.8f), glm::vec3(0), 1.0f, true});
  plain.meshes.push_back(
      {"wall", SceneBuilder().box({-6, 0, -8}, {6, 5, -7}).scene().meshes[0].primitives});
  plain.meshes[1].primitives[0].material = 1;
  plain.nodes.push_back({"wall", "city", 1, true, {SceneInstance{}}});
  const scene::RenderScene scene = builder.with({lamp({0, 6, 0}, 5000), lamp({3, 4, -3}, 2000)});
  const scene::CameraPose pose{{1, 4, 14}, {0, 3, -7}, {0, 1, 0}, 50};
  const auto mean_of = [&](render::Estimator estimator, std::uint32_t frames) {
    render::RenderSettings settings = with_estimator(estimator, 8, 30, 4);
    settings.indirect.bounces = 2;
    settings.indirect.cache = false;
    return mean_luminance(render(scene, pose, settings, 48, 32, frames));
  };
  const double expected = mean_of(render::Estimator::reference, 64);
  EXPECT_NEAR(mean_of(render::Estimator::traced, 128), expected, 0.02 * expected);
}

TEST(Textures, LeftOutTheyAreTheMeanColourOfTheirMaterial) {
  const SceneBuilder builder = chequered_ground();
  scene::PartSet none;
  none.set(static_cast<std::size_t>(scene::Part::textures));
  const scene::RenderScene scene =
      scene::make_render_scene(builder.scene(), {{lamp({0, 8, 0}, 5000)}, {}, {}, {}}, none);
  EXPECT_EQ(scene.parts[static_cast<std::size_t>(scene::Part::textures)], 1u);
  EXPECT_TRUE(scene.textures.empty());
  const measure::Image image = render(
      scene, looking_down, with_estimator(render::Estimator::reference, 8, 30, 4), 16, 16, 1);
  EXPECT_FLOAT_EQ(image.layer("albedo")->values[3 * 8 * 16], 0.9f);
}

TEST(Textures, PicturesThatCannotBeUnpackedLeaveTheColour) {
  SceneBuilder builder = chequered_ground();
  builder.scene().pictures[0].resize(40);
  const scene::RenderScene scene = builder.with({lamp({0, 8, 0}, 5000)});
  EXPECT_EQ(scene.materials.at(0).texture, 0u);
  EXPECT_EQ(scene.materials[0].base_colour, glm::vec3(0.9f));
}

TEST(Textures, ASceneWithoutThemIsCompiledWithoutThem) {
  const auto is_unneeded = [](const scene::RenderScene& scene) {
    const render::DeviceScene device_scene(test_device(), scene);
    for (const render::Feature& feature : render::list_unneeded({}, device_scene))
      if (feature.constant == CONSTANT_TEXTURES) return true;
    return false;
  };
  const std::vector<Light> lights{lamp({0, 8, 0}, 5000)};
  EXPECT_TRUE(is_unneeded(SceneBuilder().ground(5).with(lights)));
  EXPECT_FALSE(is_unneeded(chequered_ground().with(lights)));
}

}  // namespace
}  // namespace nightcity::test
