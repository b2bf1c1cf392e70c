// The renderer's settings, grouped by what they change, and the estimators by name.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "runtime/scene/light_families.h"
#include "shaders/interface.h"
#include "shaders/tonemap.glsl.h"
#include "shaders/views.glsl.h"

namespace nightcity::render {

enum class Estimator : std::uint32_t {
  reference = ESTIMATOR_REFERENCE,
  ris = ESTIMATOR_RIS,
  paper = ESTIMATOR_PAPER,
  basic = ESTIMATOR_BASIC,
  pairwise = ESTIMATOR_PAIRWISE,
  traced = ESTIMATOR_TRACED,
};

/// The traits of an estimator. A new one is a row in settings.cpp; its traits are in
/// shaders/estimators.glsl.h, which the shaders read too.
struct EstimatorTraits {
  Estimator estimator;
  const char* name;
  const char* description;
  bool samples;          // draws light candidates; the reference sums over all lights instead
  bool reuses;           // takes samples over from other frames and pixels
  bool shadowed_target;  // its target function includes visibility
  bool pairs;            // its pixels exchange samples in pairs (shaders/pairing.glsl)
  bool as_published;     // keeps to the published settings: see to_published()
};

/// All estimators, from the reference over the published one to the unbiased ones.
const std::vector<EstimatorTraits>& list_estimators();
const EstimatorTraits& traits_of(Estimator estimator);
const char* name_of(Estimator estimator);
/// Throws UsageError with the names of all estimators.
Estimator find_estimator(const std::string& name);

constexpr std::uint32_t max_candidates = 1024;
constexpr std::uint32_t max_neighbours = MAX_NEIGHBOURS;

/// Sampling of lights. The shares divide the candidates; the rest is sampled by flux.
struct SamplingSettings {
  Estimator estimator = Estimator::traced;  // chosen by measurement: docs/accuracy.md
  std::uint32_t candidates = 24;            // per pixel and frame, 1 .. max_candidates
  float near_share = 0.5f;                  // sampled from the near grid's cell
  float far_share = 0.3f;                   // sampled from the far grid's cell, the neighbourhood
  float uniform_share = 0.05f;              // sampled uniformly over all lights
  float vehicle_share =
      0.3f;  // of all candidates, at most, sampled from vehicles' lights where any shine
  // Russian roulette decides whether a sample is kept that shows less than this, in steps of an
  // 8-bit picture at the metered exposure (shaders/roulette.glsl); 0 keeps all.
  float roulette_steps = 1;
  // Sides that are rendered as a share of the picture's, 0.1 .. 1; less than 1 is upscaled.
  float resolution_scale = 1;
  // Samples every second pixel in a frame, the others in the next, and fills those that it does not
  // sample from the pixels beside them: is_half_rate().
  bool half_rate = false;
  bool jitter = true;   // sub-pixel offsets from frame to frame: anti-aliasing
  bool layers = false;  // keeps the light of each kind of source apart, too
  bool hits = false;    // keeps the triangle and the instance at each pixel's centre, too
  std::uint32_t seed = 0;

  bool operator==(const SamplingSettings&) const = default;
};

/// Reuse of samples from earlier frames and from other pixels.
struct ReuseSettings {
  std::uint32_t neighbours = 2;   // pixels reused by a pixel, 0 .. max_neighbours
  float neighbour_radius_px = 5;  // distance within which they lie
  // Bound of the history's M, in multiples of a frame's candidates; 0 = no temporal reuse.
  float max_history = 20;
  // Distance between a surface point and where its history was gathered at which half of the
  // history's M counts, m; 0 = all of it counts at any distance.
  float history_falloff_m = 1.5f;
  // Neighbours of a pixel without history, where that is more than `neighbours`.
  std::uint32_t disocclusion_boost = 0;
  bool permute = false;  // reuses the history in an order that changes from frame to frame
  // Drops shadowed candidates before reuse: less noise, biased (basic, pairwise).
  bool visibility_reuse = false;

  bool operator==(const ReuseSettings&) const = default;
};

/// Bounces in pictures that are looked at, in a file or in the window. Four have all but 0.02 % of
/// the light that eight have (docs/measurements/2026-11-26-bounces.md). Measurements of direct
/// light start from none.
constexpr std::uint32_t picture_bounces = 4;

/// Light that reaches the surface that is seen after it bounced off others.
struct IndirectSettings {
  std::uint32_t bounces = 0;  // at most, 0 .. MAX_BOUNCES
  // Takes it from the irradiance cache, which smooths it, instead of following a path of each
  // pixel. The reference always follows paths.
  bool cache = true;
  float cell_px = 4;        // side of the cache's cells
  std::uint32_t paths = 2;  // per cell and frame, more for new cells, fewer for settled ones

  bool operator==(const IndirectSettings&) const = default;
};

/// The city's own light in its sky (scene/skyglow.h), which comes into a scene as its sky map when
/// the scene is loaded.
enum class SkyGlow : std::uint32_t { none, clear, overcast };

/// Sky, moon and weather, light that is not the scene's own; and how much of the scene's own there
/// is.
struct EnvironmentSettings {
  // Luminance of rays that leave the scene, cd/m^2; where there is a sky map, a factor for it.
  glm::vec3 sky_cd_m2{0};
  SkyGlow glow = SkyGlow::none;
  // The distance from its middle to which the scene is taken to go on as it is, for the glow: most
  // scenes are parts of a larger city.
  float city_radius_km = 10;
  glm::vec3 moon_direction{0, 1, 0};  // unit vector towards the moon
  glm::vec3 moon_lux{0};              // illuminance of a surface that faces it; 0 = no moon
  float wetness = 0;                  // of surfaces that face up, 0 .. 1
  scene::LightFamilies lights = scene::all_families;  // that are on when their schedules say so
  // The vehicles on the road, as a share of those that the time of the night has; more than the
  // scene's trips there cannot be.
  float traffic = 1;

  bool operator==(const EnvironmentSettings&) const = default;
};

/// Returns the projection of that name: perspective, fisheye or equirectangular. Throws UsageError.
std::uint32_t find_projection(const std::string& name);
/// Undoes find_projection.
const char* name_projection(std::uint32_t projection);

/// Sets a moon at this place in the sky, azimuth from north over east, that gives a surface facing
/// it `lux` (full moon: 0.25). Its light is sunlight off the moon, of about 4,100 K.
void set_moon(EnvironmentSettings& environment, double azimuth_deg, double elevation_deg,
              double lux);

/// Air that weakens light and scatters it once: haze and fog.
struct AirSettings {
  // Distance at which a dark thing is just seen by day, at the scene's lowest point; 0 = clear air.
  float visibility_km = 0;
  float height_m = 0;  // over which the air gets e times as clear; 0 = the same at all heights
  // Mean cosine of scattering angles. Fog and haze scatter forwards: 0.7 to 0.9.
  float asymmetry = 0.8f;
  float albedo = 1;              // the share of weakened light that is scattered and not absorbed
  std::uint32_t candidates = 4;  // per sample, 1 .. max_candidates
  // Side of the blocks of pixels of which each frame samples one, 1 .. max_air_block. Of 2 and 4
  // candidates, the most that costs a GPU less than 2 ms.
  std::uint32_t block = 2;

  bool operator==(const AirSettings&) const = default;
};

/// The largest side of the blocks of pixels of which each frame samples the air of one.
constexpr std::uint32_t max_air_block = 8;

/// Candidates and block of still pictures, for which RMSE times the root of their time is least.
constexpr std::uint32_t picture_air_candidates = 8, picture_air_block = 1;

/// The shortest visibility, km: shorter ones count as this.
constexpr float min_visibility_km = 0.001f;

/// Returns the extinction of air at the height at which its visibility is given, 1/m: 3.912 /
/// visibility, for a contrast of 2 % (Koschmieder 1924); 0 for clear air.
float extinction_of(const AirSettings& air);

/// The frames whose mean is the picture.
struct AveragingSettings {
  bool accumulate = true;  // mean of frames; else every frame stands alone
  // Mean of at most this many frames, which follows motion; 0 = of all frames since anything moved.
  std::uint32_t window = 0;
};

/// The greatest age of an eye, years: the function of its glare is not known beyond.
constexpr float max_glare_age = 100;

/// The way from the mean to the screen.
struct DisplaySettings {
  bool denoise = false;  // filters the mean: for viewing, never for measurements
  float ev100 = 2;       // exposure
  std::uint32_t tone = TONEMAP_FILMIC;
  // An eye or a camera adds these (display.h). Frames leave them out: Renderer::expose() and
  // develop() show them.
  float glare_age = 0;        // years of the eye that scatters light, up to max_glare_age; 0 = none
  float white_balance_k = 0;  // temperature of the light that is shown as grey, K; 0 = as it is
  bool adapt_white = false;   // to the light of the scene as far as an eye does
  glm::vec3 adapted_to{0};    // that light, cd/m^2 per channel (measure::mean_light); 0 = not known
  bool mesopic = false;       // rods see in dim places
  // Renderer::expose() shows this of the picture, on a scale between these values.
  std::uint32_t view = VIEW_PICTURE;
  float view_lowest = 0.01f, view_highest = 100;

  bool operator==(const DisplaySettings&) const = default;
};

struct RenderSettings {
  SamplingSettings sampling;
  ReuseSettings reuse;
  IndirectSettings indirect;
  EnvironmentSettings environment;
  AirSettings air;
  AveragingSettings averaging;
  DisplaySettings display;
  double time_s = 8 * 3600;  // since noon
  // PROJECTION_*: the window, markers and picks know perspective alone.
  std::uint32_t projection = PROJECTION_PERSPECTIVE;
  // Features compiled into the passes although neither scene nor settings need them, to measure
  // their cost: bits 1 << CONSTANT_* of optional_features(). The picture stays the same.
  std::uint32_t forced_features = 0;
  // Counts the shadow rays of every frame: Renderer::shadow_rays(). The picture stays the same.
  bool count_rays = false;

  scene::LightMoment light_moment() const { return {time_s, environment.lights}; }
};

/// Returns whether frames of both settings may go into one mean: only their display, averaging,
/// time and forced features may differ.
bool have_same_estimate(const RenderSettings& a, const RenderSettings& b);

/// Returns whether frames sample every second pixel alone: where the settings ask for it, and the
/// estimator draws samples. Layers are kept of pixels that are sampled, so they have all sampled.
bool is_half_rate(const RenderSettings& settings);
/// Returns what half rate does to a mean of that many frames, with its bias, as pictures carry it.
std::string describe_half_rate(const AveragingSettings& averaging, std::uint32_t frames);

/// Returns how light that bounces is found, INDIRECT_* of shaders/specialization.h.
std::uint32_t find_indirect(const RenderSettings& settings);
/// Returns the same in words, with its bias, as pictures of a scene of that many lights carry it;
/// "" without bounces.
std::string describe_indirect(const RenderSettings& settings, std::uint32_t lights);

/// Returns whether a view (VIEW_*) shows light by where it comes from, so that frames must keep it
/// apart (SamplingSettings::layers).
constexpr bool needs_layers(std::uint32_t view) {
  return view == VIEW_ILLUMINANCE || view == VIEW_DIRECT || view == VIEW_INDIRECT ||
         view == VIEW_KINDS;
}

/// Returns whether a view shows triangles or instances, so that frames must keep them
/// (SamplingSettings::hits).
constexpr bool needs_hits(std::uint32_t view) {
  return view == VIEW_WIREFRAME || view == VIEW_TILES;
}

/// Makes frames keep what a view (VIEW_*) shows. What they show otherwise stays the picture, pixel
/// by pixel, so that it is metered as the picture is.
inline void keep_what_view_needs(std::uint32_t view, SamplingSettings& sampling) {
  sampling.layers |= needs_layers(view);
  sampling.hits |= needs_hits(view);
}

/// Returns the settings that the paper published: uniform candidates, every M in full, neither
/// boost nor permutation (Bitterli et al.: Spatiotemporal reservoir resampling for real-time ray
/// tracing with dynamic direct lighting, SIGGRAPH 2020). The share of vehicles' lights depends on
/// the scene; the renderer sets it.
RenderSettings to_published(RenderSettings settings);

/// Returns the settings of a draft, the first picture of a scene while most passes are still being
/// compiled: without light that bounced and without air, at full rate, from no other pixels and not
/// denoised. Only an estimator that draws samples has drafts.
RenderSettings to_draft(RenderSettings settings);

struct Feature {
  std::uint32_t constant;  // CONSTANT_*
  const char* name;
};

/// Returns the features that passes can leave out: lamps' profiles, windows,
/// schedules, the sky, wet streets, light that bounces, air.
const std::vector<Feature>& optional_features();

}  // namespace nightcity::render
