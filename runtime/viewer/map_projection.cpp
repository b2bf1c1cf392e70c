#include "runtime/viewer/map_projection.h"

#include <proj.h>

#include <cmath>

namespace nightcity::viewer {

struct MapProjection::State {
  PJ_CONTEXT* context = nullptr;
  PJ* operation = nullptr;  // from longitude and latitude to easting and northing

  ~State() {
    proj_destroy(operation);
    proj_context_destroy(context);
  }
};

MapProjection::MapProjection(const std::string& crs) {
  if (crs.empty()) return;
  auto state = std::make_unique<State>();
  state->context = proj_context_create();
  proj_log_level(state->context, PJ_LOG_NONE);
  proj_context_set_enable_network(state->context, 0);
  PJ* operation = proj_create_crs_to_crs(state->context, "OGC:CRS84", crs.c_str(), nullptr);
  if (!operation) return;
  state->operation = proj_normalize_for_visualization(state->context, operation);
  proj_destroy(operation);
  if (state->operation) state_ = std::move(state);
}

MapProjection::~MapProjection() = default;

std::optional<glm::dvec2> MapProjection::to_plane(double latitude_deg, double longitude_deg) const {
  if (!state_) return std::nullopt;
  const PJ_COORD to =
      proj_trans(state_->operation, PJ_FWD, proj_coord(longitude_deg, latitude_deg, 0, HUGE_VAL));
  if (!std::isfinite(to.xy.x) || !std::isfinite(to.xy.y)) return std::nullopt;
  return glm::dvec2(to.xy.x, to.xy.y);
}

std::optional<glm::dvec2> MapProjection::to_degrees(const glm::dvec2& easting_northing) const {
  if (!state_) return std::nullopt;
  const PJ_COORD to = proj_trans(state_->operation, PJ_INV,
                                 proj_coord(easting_northing.x, easting_northing.y, 0, HUGE_VAL));
  if (!std::isfinite(to.xy.x) || !std::isfinite(to.xy.y)) return std::nullopt;
  return glm::dvec2(to.xy.y, to.xy.x);
}

}  // namespace nightcity::viewer
