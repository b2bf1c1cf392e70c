#include "tools/bake/stages/window_stage.h"

#include <utility>

#include "tools/bake/scene/light_places.h"

namespace nightcity::bake {
namespace {

lights::WindowOptions to_window_options(lights::UseAt use_at, const WindowStageOptions& stage) {
  lights::WindowOptions options;
  options.seed = stage.seed;
  options.max_per_building = static_cast<std::size_t>(stage.max_per_building);
  options.use_at = std::move(use_at);
  return options;
}

}  // namespace

WindowConsumer::WindowConsumer(lights::UseAt use_at, const WindowStageOptions& options,
                               const std::filesystem::path& scratch)
    : layout_(to_window_options(std::move(use_at), options), scratch),
      grouping_(options.group),
      panes_(options.panes) {}

CityConsumer::Turn WindowConsumer::prepare(const std::shared_ptr<const PreparedObject>& prepared) {
  if (prepared->mesh.triangles.empty()) return {};
  auto found = prepared->windows ? *prepared->windows : find_windows(prepared->object);
  return [this, prepared, found = std::move(found)](bool) mutable {
    layout_.add(prepared->object, std::move(found));
  };
}

lights::WindowReport WindowConsumer::finish(const City& city,
                                            const lights::WindowLayout::Sink& sink) {
  const auto inside = [&](const glm::dvec3& p) { return inside_building(city.terrain(), p); };
  lights::WindowGrouper grouper(grouping_, sink);
  lights::WindowReport report = std::move(layout_).finish(
      city.height_at(), [&](const lights::LitRectangle& window) { grouper.add(window); }, inside,
      city.inputs().read.threads);
  grouper.finish();
  report.emitters = grouper.emitters();
  return report;
}

}  // namespace nightcity::bake
