// A frame in slices is the frame in one piece, and one that is given up leaves nothing behind.
#include "runtime/render/frame_run.h"

#include <gtest/gtest.h>

#include "runtime/measure/exposure.h"
#include "runtime/render/frame_steps.h"
#include "runtime/render/pass_constants.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::render {
namespace {

constexpr double slice_s = 1e-6;  // the smallest part of a step at a time
constexpr double for_ever = std::numeric_limits<double>::infinity();

class Slices : public testing::Test {
 protected:
  std::size_t finish(Renderer& renderer) {
    std::size_t slices = 1;
    while (!renderer.continue_frame(slice_s, for_ever)) ++slices;
    return slices;
  }
  Renderer make(std::uint32_t width = 96, std::uint32_t height = 72) {
    return Renderer(test::test_device(), test::test_passes(), device_scene_, width, height);
  }
  void TearDown() override { EXPECT_TRUE(test::test_device().validation_messages().empty()); }

  scene::RenderScene scene_ = test::random_town(30, 60, 7).with(test::random_lamps(20, 50, 8));
  DeviceScene device_scene_{test::test_device(), scene_};
  scene::CameraPose pose_{{40, 30, 40}, {0, 0, 0}, {0, 1, 0}, 50};
  RenderSettings settings_;
};

// The window ends, or stops saving a picture, amid a frame. The device must not find its buffers
// gone: this would end by a signal.
TEST_F(Slices, ARendererThatGoesWaitsForWhatIsSubmitted) {
  settings_.sampling.estimator = Estimator::reference;
  for (int i = 0; i < 4; ++i) {
    Renderer renderer = make(320, 240);  // seconds of work on a CPU driver
    renderer.begin_frame(pose_, settings_);
    renderer.continue_frame(for_ever, 0);
    EXPECT_TRUE(renderer.is_busy());
  }
}

TEST_F(Slices, MakeTheSamePictureBitByBit) {
  for (const Estimator estimator : {Estimator::traced, Estimator::basic, Estimator::reference})
    for (const bool denoise : {false, true}) {
      settings_.sampling.estimator = estimator;
      settings_.display.denoise = denoise;
      Renderer whole = make(), sliced = make();
      std::size_t slices = 0;
      for (int i = 0; i < 3; ++i) {
        whole.render_frame(pose_, settings_);
        sliced.begin_frame(pose_, settings_);
        slices = finish(sliced);
      }
      EXPECT_GT(slices, 20u);
      EXPECT_EQ(sliced.frames(), 3u);
      EXPECT_EQ(whole.download(false).rgb, sliced.download(false).rgb) << name_of(estimator);
    }
}

TEST_F(Slices, TheFrameBeforeIsShownUntilTheNextIsComplete) {
  Renderer renderer = make();
  renderer.render_frame(pose_, settings_);
  const std::vector<float> first = renderer.download(false).rgb;
  const auto shown = renderer.display().read<std::uint32_t>(96 * 72);
  renderer.set_size(48, 36);
  renderer.begin_frame(pose_, settings_);
  EXPECT_FALSE(renderer.continue_frame(slice_s, for_ever));
  EXPECT_EQ(renderer.width(), 96u);
  EXPECT_EQ(renderer.download(false).rgb, first);
  EXPECT_EQ(renderer.display().read<std::uint32_t>(96 * 72), shown);
  EXPECT_GT(renderer.share_done(), 0.0);
  EXPECT_LT(renderer.share_done(), 1.0);
  finish(renderer);
  EXPECT_EQ(renderer.width(), 48u);
  EXPECT_EQ(renderer.height(), 36u);
}

// Every other frame is given up half-way; the mean of the others is unbiased, and the number of
// frames in it is right.
TEST_F(Slices, AFrameThatIsGivenUpLeavesTheMeanAsItWas) {
  Renderer renderer = make();
  renderer.render_frame(pose_, settings_);
  const std::vector<float> first = renderer.download(false).rgb;
  for (int i = 0; i < 3; ++i) {
    scene::CameraPose elsewhere = pose_;
    elsewhere.position.x += 5;
    renderer.begin_frame(i == 1 ? pose_ : elsewhere, settings_);
    for (int slice = 0; slice < 10; ++slice) renderer.continue_frame(slice_s, for_ever);
    renderer.abandon_frame();
    EXPECT_FALSE(renderer.has_begun());
    EXPECT_EQ(renderer.frames(), 1u);
    EXPECT_EQ(renderer.download(false).rgb, first);
  }
  renderer.render_frame(pose_, settings_);
  EXPECT_EQ(renderer.frames(), 2u);
}

// Levels from coarse to fine hand their reservoirs on. What they hand on stays unbiased: the mean
// over many short refinements is the reference's.
TEST_F(Slices, RefinementFromCoarseToFineStaysUnbiased) {
  RenderSettings truth = settings_;
  truth.sampling.estimator = Estimator::reference;
  truth.sampling.jitter = settings_.sampling.jitter = false;
  Renderer judge = make(32, 24);
  for (int i = 0; i < 4; ++i) judge.render_frame(pose_, truth);
  const double expected = test::mean_luminance(judge.download(false));

  const Effort quick{4, 0};
  Renderer renderer = make(8, 6);
  double sum = 0;
  constexpr int runs = 150;
  for (int run = 0; run < runs; ++run) {
    settings_.sampling.seed = static_cast<std::uint32_t>(run);  // starts anew, without history
    for (const std::uint32_t divisor : {4u, 2u, 1u}) {
      renderer.set_size(32 / divisor, 24 / divisor);
      renderer.begin_frame(pose_, settings_, divisor == 1 ? Effort{} : quick);
      while (!renderer.continue_frame(for_ever, for_ever)) {
      }
      EXPECT_EQ(renderer.frames(), 1u);
    }
    sum += test::mean_luminance(renderer.download(false));
  }
  std::printf("  mean of refinements over truth: %+.2f %%\n", 100 * (sum / runs / expected - 1));
  EXPECT_NEAR(sum / runs / expected, 1, 0.03);  // six standard deviations of the mean
}

// The sky of a picture that grew has no history: its pixels are more than the frame before had.
// Guard pages (tests/runtime/guarded) find out whether that is read all the same.
TEST_F(Slices, AMeanThatMovesStartsAnewWhereThePictureGrows) {
  settings_.averaging.window = 8;
  settings_.environment.sky_cd_m2 = glm::vec3(3);
  pose_.target = {40, 60, 0};
  Renderer renderer = make(8, 6);
  renderer.render_frame(pose_, settings_);
  renderer.set_size(48, 36);
  renderer.render_frame(pose_, settings_);
  const std::vector<float> grown = renderer.download(false).rgb;
  Renderer anew = make(48, 36);
  anew.render_frame(pose_, settings_);
  EXPECT_EQ(grown.front(), anew.download(false).rgb.front());
  EXPECT_GT(grown.front(), 0);
}

// A cell that is new gets eight paths in a whole frame of the default settings, and one here.
TEST_F(Slices, AQuickFrameFollowsOnePathOfEachCell) {
  settings_.count_rays = true;
  const auto count_rays = [&](std::uint32_t bounces, const Effort& effort) {
    settings_.indirect.bounces = bounces;
    Renderer renderer = make();
    renderer.begin_frame(pose_, settings_, effort);
    while (!renderer.continue_frame(for_ever, for_ever)) {
    }
    return double(renderer.shadow_rays());
  };
  Effort quick;
  quick.max_cell_paths = 1;
  const double direct = count_rays(0, {}), whole = count_rays(2, {}) - direct,
               few = count_rays(2, quick) - direct;
  EXPECT_GT(few, 0);
  EXPECT_NEAR(few / whole, 1 / 8.0, 0.02);
}

// A part of a step cannot be cut: on a CPU, which traces about a million rays a second, it is to be
// over soon, however many lights there are.
TEST_F(Slices, APartOfTheReferenceIsShortOnACpuHoweverManyLights) {
  RenderSettings settings;
  settings.sampling.estimator = Estimator::reference;
  for (const std::uint32_t lights : {1'000u, 100'000u, 10'000'000u})
    for (const glm::uvec2 size : {glm::uvec2{40, 30}, {160, 90}, {1280, 720}}) {
      const std::uint32_t rays = WORKGROUP_SIZE * WORKGROUP_SIZE * REFERENCE_CHUNK *
                                 choose_reference_slices(settings, size, lights, true);
      EXPECT_LE(rays, 1u << 13) << size.x;
    }
  EXPECT_EQ(choose_reference_slices(settings, {160, 90}, 100'000, false), 32u);
  EXPECT_EQ(choose_reference_slices(settings, {20, 28}, 300, true), 3u) << "one for each chunk";
}

TEST_F(Slices, ExposingAnewShowsTheSameMeanAsRenderingWithThatExposure) {
  for (const bool denoise : {false, true}) {
    settings_.display.denoise = denoise;
    Renderer renderer = make();
    renderer.render_frame(pose_, settings_);
    const std::vector<float> mean = renderer.download(false).rgb;
    DisplaySettings display = settings_.display;
    display.ev100 = -1;
    display.tone = TONEMAP_REINHARD;
    renderer.expose(display);
    EXPECT_EQ(renderer.download(false).rgb, mean);
    EXPECT_EQ(renderer.download(false).info.ev100, -1.0f);
    const measure::Image8 expected =
        measure::to_display(renderer.download(false), -1, TONEMAP_REINHARD);
    const auto words = renderer.display().read<std::uint32_t>(96 * 72);
    std::size_t different = 0;
    for (std::size_t i = 0; i < words.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        different += std::abs(int(words[i] >> (8 * c) & 255u) - int(expected.rgb[3 * i + c])) > 1;
    EXPECT_EQ(different, 0u);
  }
}

TEST_F(Slices, TheSampleForMeteringIsOfThePicturesRows) {
  Renderer renderer = make();
  renderer.render_frame(pose_, settings_);
  const measure::Image all = renderer.download(false), sample = renderer.sample_mean(96 * 9);
  ASSERT_EQ(sample.width, 96u);
  ASSERT_EQ(sample.height, 9u);
  for (std::size_t row = 0; row < 9; ++row)
    for (std::size_t x = 0; x < 96; ++x)
      EXPECT_EQ(sample.rgb[3 * (row * 96 + x)], all.rgb[3 * (row * 8 * 96 + x)]);
  EXPECT_EQ(renderer.sample_mean(1).height, 1u);
  EXPECT_EQ(renderer.sample_mean(std::size_t{1} << 30).height, 72u);
}

TEST_F(Slices, AScaledFrameHasFewerPixelsAndItsPictureAllOfThem) {
  settings_.sampling.estimator = Estimator::reference;
  const auto mean_of = [](const measure::Image& image) {
    double sum = 0;
    for (const float value : image.rgb) sum += double{value};
    return sum / double(image.rgb.size());
  };
  Renderer whole = make(), scaled = make();
  for (int i = 0; i < 4; ++i) whole.render_frame(pose_, settings_);
  settings_.sampling.resolution_scale = 0.5f;
  for (int i = 0; i < 4; ++i) scaled.render_frame(pose_, settings_);
  EXPECT_EQ(scaled.width(), 48u);
  EXPECT_EQ(scaled.height(), 36u);
  EXPECT_EQ(scaled.picture_size(), glm::uvec2(96, 72));
  const measure::Image picture = scaled.download();
  EXPECT_EQ(picture.width, 96u);
  EXPECT_EQ(picture.height, 72u);
  EXPECT_EQ(picture.layer("depth")->values.size(), picture.pixels());
  EXPECT_NE(picture.info.estimator.find("upscaled from 48 x 36"), std::string::npos);
  EXPECT_NEAR(mean_of(picture) / mean_of(whole.download(false)), 1, 0.05);
  // An effort scales what the settings ask for, and begins a mean.
  scaled.begin_frame(pose_, settings_, {.resolution_scale = 0.5f});
  while (!scaled.continue_frame(1, 1)) {
  }
  EXPECT_EQ(scaled.width(), 24u);
  EXPECT_EQ(scaled.frames(), 1u);
  EXPECT_EQ(scaled.download(false).width, 96u);
}

// Every choice of settings compiles a set of its own, and a window is open for long: sets that
// nobody holds are let go of, the one that was asked for longest ago first.
TEST_F(Slices, PassesThatWereLongNotAskedForAreLetGoOf) {
  PassLibrary passes(test::test_device(), 2);
  const auto constants_of = [&](Estimator estimator) {
    RenderSettings settings = settings_;
    settings.sampling.estimator = estimator;
    return find_constants(settings, device_scene_.traits());
  };
  const PassConstants one = constants_of(Estimator::ris), two = constants_of(Estimator::reference),
                      three = constants_of(Estimator::pairwise);
  const std::weak_ptr<const PassSet> first = passes.get(one), second = passes.get(two);
  EXPECT_TRUE(passes.is_ready(one));
  const std::shared_ptr<const PassSet> held = passes.get(three);
  EXPECT_FALSE(first.expired()) << "it was asked for after the second";
  EXPECT_TRUE(second.expired());
  passes.get(two);
  passes.get(one);
  EXPECT_EQ(held.use_count(), 1) << "who holds a set keeps it";
}

// A window shows a draft while most passes are still being compiled. What it shows afterwards is
// what it would have shown without.
TEST_F(Slices, ADraftLeavesNoTrace) {
  settings_.indirect = {.bounces = 2, .cache = false};
  settings_.display.denoise = true;
  const auto draft = [&](Renderer& renderer, const scene::CameraPose& pose) {
    renderer.begin_frame(pose, settings_, {.draft = true});
    while (!renderer.continue_frame(for_ever, for_ever)) {
    }
  };
  scene::CameraPose aside = pose_;
  aside.position.x += 1;
  Renderer with = make(), without = make(), direct = make();
  draft(with, aside);
  draft(with, pose_);
  RenderSettings no_bounces;
  no_bounces.reuse.neighbours = 0;
  direct.render_frame(pose_, no_bounces);
  EXPECT_EQ(with.download(false).rgb, direct.download(false).rgb)
      << "a first frame of direct light";
  EXPECT_EQ(with.download(false).info.bounces, 0u);
  for (int i = 0; i < 3; ++i) {
    with.render_frame(pose_, settings_);
    without.render_frame(pose_, settings_);
    EXPECT_EQ(with.frames(), without.frames());
    EXPECT_EQ(with.download(false).rgb, without.download(false).rgb) << i;
  }
}

// Drafts wait for fewer passes than frames do, and do without the others.
TEST_F(Slices, ADraftNeedsItsOwnPassesAlone) {
  PassLibrary passes(test::test_device());
  Renderer renderer(test::test_device(), passes, device_scene_, 16, 16);
  while (!renderer.is_draft_ready(settings_)) {
  }
  EXPECT_FALSE(renderer.has_passes(settings_));
  renderer.begin_frame(pose_, settings_, {.draft = true});
  while (!renderer.continue_frame(for_ever, for_ever)) {
  }
  EXPECT_EQ(renderer.frames(), 1u);
  RenderSettings inspected = settings_;
  inspected.display.view = VIEW_LUMINANCE;
  renderer.expose(inspected.display);  // has no pass yet: it shows the picture
  EXPECT_FALSE(renderer.has_passes(settings_));
}

TEST_F(Slices, PassesAreCompiledInTheBackground) {
  PassLibrary passes(test::test_device());
  Renderer renderer(test::test_device(), passes, device_scene_, 16, 16);
  const RenderSettings other = [&] {
    RenderSettings changed = settings_;
    changed.sampling.estimator = Estimator::ris;
    return changed;
  }();
  while (!renderer.is_ready(settings_)) {
  }
  renderer.is_ready(other);  // begins to compile, and get() takes what it compiled
  renderer.render_frame(pose_, other);
  EXPECT_TRUE(renderer.is_ready(other));
  EXPECT_TRUE(renderer.is_ready(settings_));
}

}  // namespace
}  // namespace nightcity::render
