// Projections of the camera: which direction each pixel shows, and that reuse finds it again.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/error.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::render {
namespace {

using test::lamp;
using test::SceneBuilder;

using std::numbers::pi;
constexpr std::uint32_t width = 64, height = 32;
const scene::CameraPose pose{
    {0, 2, 0}, {0, 1.5f, -10}, {0, 1, 0}, 60};  // to the north, down a little

// A closed room, so that every ray meets a wall.
scene::RenderScene make_room() {
  return SceneBuilder().box({-6, 0, -5}, {7, 5, 8}).with({lamp({3, 4, -2}, 2000, 0.1f)});
}

measure::Image render_room(std::uint32_t projection, Estimator estimator, int frames) {
  const scene::RenderScene room = make_room();
  DeviceScene on_device(test::test_device(), room);
  Renderer renderer(test::test_device(), test::test_passes(), on_device, width, height);
  RenderSettings settings;
  settings.projection = projection;
  settings.sampling.estimator = estimator;
  settings.sampling.jitter = false;
  settings.indirect.bounces = 1;
  for (int i = 0; i < frames; ++i) renderer.render_frame(pose, settings);
  return renderer.download();
}

// Compares the place that each pixel shows with a direction of the mathematics.
template <class DirectionAt>
void expect_directions(std::uint32_t projection, DirectionAt direction_at) {
  const measure::Image image = render_room(projection, Estimator::traced, 1);
  const std::vector<float>& positions = image.layer("position")->values;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t at = 3 * (std::size_t{y} * width + x);
      const glm::dvec3 seen =
          glm::normalize(glm::dvec3(positions[at], positions[at + 1], positions[at + 2]) -
                         glm::dvec3(pose.position));
      const glm::dvec3 expected =
          direction_at(2 * (x + 0.5) / width - 1, 2 * (y + 0.5) / height - 1);
      ASSERT_NEAR(glm::distance(seen, expected), 0, 1e-4) << x << " " << y;
    }
}

// The middle is the north, and the horizon level although the view is not.
TEST(Projection, EquirectangularIsLongitudeByLatitude) {
  expect_directions(PROJECTION_EQUIRECTANGULAR, [](double x, double y) {
    const double longitude = x * pi, latitude = -y * pi / 2;
    return glm::dvec3(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                      -std::cos(latitude) * std::cos(longitude));
  });
}

TEST(Projection, FisheyeHasTheAngleOffTheAxisInProportionToTheRadius) {
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(pose.target) - glm::dvec3(pose.position));
  const glm::dvec3 right(1, 0, 0), up = glm::cross(right, ahead);
  expect_directions(PROJECTION_FISHEYE, [&](double x, double y) {
    const double across = x * width / height, radius = std::hypot(across, y);
    const double angle = std::min(radius * pi / 2, pi);
    return std::cos(angle) * ahead +
           std::sin(angle) / std::max(radius, 1e-12) * (across * right - y * up);
  });
}

// Reservoirs and cells of the cache are found again in the next frame, at the same light.
TEST(Projection, ReuseShowsTheLightOfTheReference) {
  for (const std::uint32_t projection : {PROJECTION_FISHEYE, PROJECTION_EQUIRECTANGULAR}) {
    const double truth = test::mean_luminance(render_room(projection, Estimator::reference, 16)),
                 ours = test::mean_luminance(render_room(projection, Estimator::traced, 48));
    EXPECT_NEAR(ours / truth, 1, 0.02) << projection;
  }
}

TEST(Projection, NamesAreThoseOfTheOption) {
  EXPECT_EQ(find_projection("perspective"), PROJECTION_PERSPECTIVE);
  EXPECT_EQ(find_projection("equirectangular"), PROJECTION_EQUIRECTANGULAR);
  EXPECT_THROW(find_projection("mercator"), UsageError);
}

}  // namespace
}  // namespace nightcity::render
