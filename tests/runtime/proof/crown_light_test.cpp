// Light of a lamp through the crowns of baked trees against its closed form: the unshaded
// illuminance times exp(-n) for each crown on its way, where n is the mean number of leaves that a
// ray meets there. Leaves are strewn evenly in a ball, which is stretched to a crown; a ray that is
// stretched with it meets as many (tools/trees/crown.h).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "formats/scene_reader.h"
#include "runtime/scene/trace_ray.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/process.h"
#include "support/scenes.h"
#include "tools/random.h"
#include "tools/trees/crown.h"

namespace nightcity::test {
namespace {

using std::numbers::pi;

constexpr double height_m = 16, crown_m = 6;
// The lowest leaf hangs at a quarter of the height (tools/trees/find_trees.cpp).
constexpr double clear_m = 4, out_m = crown_m / 2, up_m = (height_m - clear_m) / 2;
constexpr double trunk_m = 0.25;  // a trunk's radius is 0.24 m
constexpr int side = 14;          // trees in a row of the orchard
constexpr double flux_lm = 1e5;

struct Crown {
  std::string season;
  double gap;
  double length, width;  // of leaves, in radii of the crown (tools/bake/scene/tree_models.cpp)
  // All crowns are one draw of n leaves, turned. Some n / 4 decide the light T of a ring of rays,
  // so it is off its mean by some T ln(1 / T) / sqrt(n / 4): at most 0.02 for 1330 leaves and 0.06
  // for 155 twigs.
  double tolerance;
};

// Writes a map of trees of one size, 24 m apart, and two sheds that make the ground reach beyond
// them. Bakes it as its users do.
bool bake_orchard(const TempFolder& folder, const std::string& season) {
  constexpr double lon = 13, lat = 52, metre_e = 1 / (111320 * 0.6157), metre_n = 1 / 111250.0;
  std::string nodes, ways;
  int id = 0;
  const auto add_node = [&](double e, double n, const std::string& tags) {
    nodes += "<node id='" + std::to_string(++id) + "' lon='" + std::to_string(lon + e * metre_e) +
             "' lat='" + std::to_string(lat + n * metre_n) + "'>" + tags + "</node>\n";
  };
  for (const double corner : {-230.0, 230.0}) {
    const int first = id + 1;
    for (const auto& [e, n] : {std::array{0, 0}, {4, 0}, {4, 4}, {0, 4}})
      add_node(corner + e, corner + n, "");
    ways += "<way id='" + std::to_string(first) + "'>";
    for (const int k : {0, 1, 2, 3, 0}) ways += "<nd ref='" + std::to_string(first + k) + "'/>";
    ways += "<tag k='building' v='shed'/><tag k='height' v='3'/></way>\n";
  }
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      add_node(24 * (i - side / 2), 24 * (j - side / 2),
               "<tag k='natural' v='tree'/><tag k='height' v='16'/>"
               "<tag k='diameter_crown' v='6'/>");
  write_text(folder / "trees.osm", "<osm version='0.6'>\n" + nodes + ways + "</osm>\n");
  write_text(folder / "trees.toml",
             "[osm]\nfiles = ['trees.osm']\n[ground]\ntrees = '" + season + "'\n");
  const Outcome outcome = run_program("nightbake", "run '" + (folder / "trees.toml").string() +
                                                       "' --out '" + folder.path().string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0;
}

// The mean number of leaves that a ray meets, by its distance from the middle of the unit ball.
class LeavesOnRay {
 public:
  // Leaves of `length` by `width` hang with their middles in the ball, so some reach beyond it. The
  // share `gap` of the light on the ball passes them.
  LeavesOnRay(double gap, double length, double width) {
    Random random{3};
    constexpr int samples = 20'000;
    // A leaf that shows the share |cos| of its area covers a ray if its middle lies in the chord
    // that is as far beside the ray as a point of the leaf is beside its middle. The mean of |cos|
    // is 1/2 (Cauchy), so for a depth of 1 and leaves without an extent it is c / 2.
    for (int n = 0; n < samples; ++n) {
      const double z = random.range(-1, 1), turn = random.range(0, 2 * pi),
                   spin = random.range(0, 2 * pi), s = random.range(-0.5, 0.5) * length,
                   t = random.range(-0.5, 0.5) * width, u = std::cos(spin) * s - std::sin(spin) * t,
                   v = (std::sin(spin) * s + std::cos(spin) * t) * std::abs(z);
      const glm::dvec2 aside(std::cos(turn) * u - std::sin(turn) * v,
                             std::sin(turn) * u + std::cos(turn) * v);
      for (std::size_t i = 0; i < means_.size(); ++i) {
        const double square = 1 - std::pow(step * double(i) - aside.x, 2) - aside.y * aside.y;
        if (square > 0) means_[i] += std::abs(z) * 2 * std::sqrt(square) / samples;
      }
    }
    const double depth = find_depth(gap);
    for (double& mean : means_) mean *= depth;
  }

  double find(double offset) const {
    const double place = offset / step;
    const auto i = std::size_t(std::min(place, 1e6));
    if (i + 1 >= means_.size()) return 0;
    return means_[i] + (place - double(i)) * (means_[i + 1] - means_[i]);
  }

 private:
  // Returns the depth of which the mean of exp(-depth mean) over the disc of the ball is `gap`.
  double find_depth(double gap) const {
    const auto find_gap = [&](double depth) {
      double sum = 0;
      for (int i = 0; i < 1000; ++i)  // rings of equal area
        sum += std::exp(-depth * find(std::sqrt((i + 0.5) / 1000))) / 1000;
      return sum;
    };
    double low = 0, high = 100;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (find_gap(middle) > gap ? low : high) = middle;
    }
    return low;
  }

  static constexpr double step = 0.01;
  std::vector<double> means_ = std::vector<double>(142);
};

class CrownLight : public testing::TestWithParam<Crown> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::filesystem::path(NIGHTCITY_BUILD_DIR) / "nightbake"))
      GTEST_SKIP() << "nightbake is not built";
    ASSERT_TRUE(bake_orchard(folder_, GetParam().season));
    scene_ = read_scene(folder_ / "city.glb");
    for (const SceneNode& node : scene_.nodes)
      if (node.name == "trunks")
        for (const SceneInstance& tree : node.instances)
          feet_.push_back(glm::dvec3(glm::vec3(tree.to_model[3])));
    ASSERT_EQ(feet_.size(), std::size_t(side * side));
    for (const SceneMaterial& material : scene_.materials)
      if (material.name == "terrain")
        reflectance_ = glm::dot(glm::dvec3(material.base_colour), {0.2126, 0.7152, 0.0722});
    ASSERT_GT(reflectance_, 0);
  }

  scene::RenderScene light_with(const glm::dvec3& place) const {
    return scene::make_render_scene(scene_,
                                    {{lamp(glm::vec3(place), float(flux_lm), 0.02f)}, {}, {}, {}});
  }

  // The distance at which a ray passes the middle of a crown, in radii of the ball that it was.
  static double find_offset(const glm::dvec3& foot, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 radii(out_m, up_m, out_m),
        p = (from - foot - glm::dvec3(0, clear_m + up_m, 0)) / radii,
        d = glm::normalize((to - from) / radii);
    return glm::length(p - glm::dot(p, d) * d);
  }

  // Trunks are solid: rays near one tell nothing about crowns.
  static bool meets_trunk(const glm::dvec3& foot, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec2 p(from.x - foot.x, from.z - foot.z), d(to.x - from.x, to.z - from.z);
    const double t =
        glm::dot(d, d) > 0 ? std::clamp(-glm::dot(p, d) / glm::dot(d, d), 0.0, 1.0) : 0;
    return glm::length(p + t * d) < trunk_m;
  }

  struct Path {
    double leaves = 0;   // in the mean, over all crowns on the way
    double nearest = 9;  // the least offset
    bool clear = true;   // of trunks
    double passing() const { return std::exp(-leaves); }
  };
  Path find_path(const glm::dvec3& from, const glm::dvec3& to) const {
    Path path;
    for (const glm::dvec3& foot : feet_) {
      const double offset = find_offset(foot, from, to);
      path.leaves += leaves_.find(offset);
      path.nearest = std::min(path.nearest, offset);
      path.clear = path.clear && !meets_trunk(foot, from, to);
    }
    return path;
  }

  // E = I cos / d^2 of a lamp that shines evenly.
  static double unshaded_lx(const glm::dvec3& ground, const glm::dvec3& lamp) {
    const glm::dvec3 to = lamp - ground;
    const double d = glm::length(to);
    return flux_lm / (4 * pi) * (to.y / d) / (d * d);
  }

  const TempFolder folder_;
  Scene scene_;
  std::vector<glm::dvec3> feet_;
  double reflectance_ = 0;
  LeavesOnRay leaves_{GetParam().gap, GetParam().length, GetParam().width};
};

// Light that arrives, as measured, by the closed form, and without crowns.
struct Sums {
  double arrived = 0, closed_form = 0, unshaded = 0;

  void add(double arrived_lx, double unshaded_lx, double passing) {
    arrived += arrived_lx;
    closed_form += unshaded_lx * passing;
    unshaded += unshaded_lx;
  }
  void expect_equal(const char* what, double value, double tolerance) const {
    std::printf("  to %g %s: %.4f of the light passes, %.4f by the closed form\n", value, what,
                arrived / unshaded, closed_form / unshaded);
    EXPECT_NEAR(arrived / unshaded, closed_form / unshaded, tolerance) << value << " " << what;
  }
};

// A lamp 25 m from the middle of each crown, from straight above to 60 degrees beside it, and the
// ground where its light comes through that crown.
TEST_P(CrownLight, OnTheGroundIsTheUnshadedLightTimesTheGapsOnItsWay) {
  const scene::RenderScene scene = light_with({0, 30, 0});
  Random random{11};
  std::array<Sums, 3> by_angle;   // up to 20, 40, 60 degrees, within the ball
  std::array<Sums, 5> by_offset;  // up to 0.5, 0.75, 0.9, 1, 1.3 radii
  constexpr std::array offsets{0.5, 0.75, 0.9, 1.0, 1.3};
  for (std::size_t n = 0; n < feet_.size(); ++n) {
    const std::size_t third = n % 3;
    const double angle = random.range(20.0 * double(third), 20.0 * double(third + 1)) * pi / 180,
                 turn = random.range(0, 2 * pi);
    const glm::dvec3 aside(std::cos(turn), 0, std::sin(turn)), up(0, 1, 0),
        middle = feet_[n] + (clear_m + up_m) * up,
        lamp = middle + 25.0 * (std::cos(angle) * up + std::sin(angle) * aside),
        shadow = feet_[n] - (clear_m + up_m) * std::tan(angle) * aside;
    for (int i = 0; i < 3000; ++i) {
      const glm::dvec3 ground =
          shadow + glm::dvec3(random.range(-20, 20), 1e-3, random.range(-20, 20));
      const double offset = find_offset(feet_[n], ground, lamp);
      if (offset >= offsets.back()) continue;
      const Path path = find_path(ground, lamp);
      if (offset > path.nearest || !path.clear) continue;
      const double unshaded = unshaded_lx(ground, lamp);
      const bool passes =
          !scene::trace_ray(scene, ground, lamp - ground, 1, MASK_SHADOW).has_value();
      const auto ring =
          std::size_t(std::upper_bound(offsets.begin(), offsets.end(), offset) - offsets.begin());
      by_offset[ring].add(passes ? unshaded : 0, unshaded, path.passing());
      if (offset < 1) by_angle[third].add(passes ? unshaded : 0, unshaded, path.passing());
    }
  }
  for (std::size_t i = 0; i < 3; ++i)
    by_angle[i].expect_equal("degrees", 20.0 * double(i + 1), GetParam().tolerance);
  for (std::size_t i = 0; i < 5; ++i)
    by_offset[i].expect_equal("radii", offsets[i], GetParam().tolerance);
}

// The renderer's picture of the ground in the shadows of crowns, one or several behind each other:
// L = reflectance / pi E.
TEST_P(CrownLight, InAPictureIsTheSame) {
  const glm::dvec3 lamp(130, 110, 40);
  const measure::Image image =
      render(light_with(lamp), {{0, 180, 0.001f}, {0, 0, 0}, {0, 0, -1}, 40},
             with_estimator(render::Estimator::reference), 256, 256, 1);
  const auto& points = image.layer("position")->values;
  Sums shaded, open;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const glm::dvec3 ground(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    if (std::abs(ground.y) > 0.01) continue;  // a crown
    const Path path = find_path(ground, lamp);
    if (!path.clear) continue;
    Sums& sums = path.nearest < 1 ? shaded : open;
    pixels += path.nearest < 1;
    sums.add(luminance(image, i) * pi / reflectance_, unshaded_lx(ground, lamp), path.passing());
  }
  EXPECT_GT(pixels, 2000u);
  shaded.expect_equal("radii", 1, 0.02);
  open.expect_equal("radii", 9, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Seasons, CrownLight,
                         testing::Values(Crown{"summer", trees::gap_with_leaves, 0.2, 0.12, 0.04},
                                         Crown{"winter", trees::gap_without_leaves, 0.7, 0.05,
                                               0.06}),
                         [](const auto& parameter) { return parameter.param.season; });

}  // namespace
}  // namespace nightcity::test
