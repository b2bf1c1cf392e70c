#include "runtime/viewer/frame_stats.h"

namespace nightcity::viewer {

void describe_city(const City& city, FrameStats& stats) {
  const scene::RenderScene& scene = city.scene;
  stats.scene = name_of(city.path);
  stats.triangles = city.triangles;
  stats.lights = scene.lights.size();
  stats.has_light = !scene.lights.empty() || !scene.traffic.trips.empty();
  stats.licences = scene.georeference.licences;
}

void describe_picture(const LivePicture& picture, FrameStats& stats) {
  const render::Renderer& renderer = picture.renderer();
  stats.width = renderer.width();
  stats.height = renderer.height();
  stats.divisor = picture.shown().divisor;
  stats.frames = renderer.frames();
  stats.made_with = picture.made_with();
  stats.passes = renderer.timings();
  stats.frame_ms = 1000 * renderer.frame_s();
}

}  // namespace nightcity::viewer
