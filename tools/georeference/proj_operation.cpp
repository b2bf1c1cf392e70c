#include "tools/georeference/proj_operation.h"

#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace nightcity::georeference {
namespace {

struct ListDeleter {
  void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const {
    proj_operation_factory_context_destroy(factory);
  }
};

bool covers(PJ_CONTEXT* context, const PJ* operation, const glm::dvec2* place) {
  double west = 0, south = 0, east = 0, north = 0;
  if (!place || !proj_get_area_of_use(context, operation, &west, &south, &east, &north, nullptr) ||
      west < -999)
    return true;
  const bool in_longitude =
      west <= east ? place->x >= west && place->x <= east : place->x >= west || place->x <= east;
  return in_longitude && place->y >= south && place->y <= north;
}

constexpr double unstated_m = 1000, guess_m = 10000;  // ranks of operations that state nothing

// Rank: smaller is better.
double rank(PJ_CONTEXT* context, const PJ* operation) {
  if (proj_coordoperation_has_ballpark_transformation(context, operation)) return guess_m;
  const double accuracy = proj_coordoperation_get_accuracy(context, operation);
  return accuracy >= 0 ? accuracy : unstated_m;
}

// Returns the best operation, `third_datums` or none between the two.
PjPtr find_best(PJ_CONTEXT* context, const PJ* crs, const glm::dvec2* place,
                PROJ_INTERMEDIATE_CRS_USE third_datums) {
  const PjPtr wgs84{proj_create(context, "OGC:CRS84")};
  const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, ListDeleter> factory{
      proj_create_operation_factory_context(context, nullptr)};
  if (!wgs84 || !factory) return nullptr;
  proj_operation_factory_context_set_allow_use_intermediate_crs(context, factory.get(),
                                                                third_datums);
  proj_operation_factory_context_set_spatial_criterion(context, factory.get(),
                                                       PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  proj_operation_factory_context_set_grid_availability_use(
      context, factory.get(), PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID);
  const std::unique_ptr<PJ_OBJ_LIST, ListDeleter> all{
      proj_create_operations(context, wgs84.get(), crs, factory.get())};
  PjPtr best;
  double best_rank = std::numeric_limits<double>::infinity();
  for (int i = 0; all && i < proj_list_get_count(all.get()); ++i) {
    PjPtr operation{proj_list_get(context, all.get(), i)};
    if (!operation || !proj_coordoperation_is_instantiable(context, operation.get()) ||
        !covers(context, operation.get(), place))
      continue;
    if (const double r = rank(context, operation.get()); r < best_rank) {
      best_rank = r;
      best = std::move(operation);
    }
  }
  return best;
}

std::string to_steps(PJ_CONTEXT* context, const PJ* operation) {
  const char* const said = proj_as_proj_string(context, operation, PJ_PROJ_5, nullptr);
  std::string text = said ? said : "";
  constexpr std::string_view pipeline = "+proj=pipeline";
  if (text.starts_with(pipeline)) return text.substr(pipeline.size());
  return text.empty() ? text : " +step " + text;
}

// PROJ looks for operations through third datums between two CRSs in degrees alone where one of
// them is known at other places: for a grid they are made of those and its projection. Null where
// there is nothing better than a guess.
PjPtr find_through_degrees(PJ_CONTEXT* context, const PJ* crs, const glm::dvec2* place) {
  const PjPtr degrees{proj_crs_get_geodetic_crs(context, crs)};
  if (!degrees) return nullptr;
  PjPtr to_degrees = find_best(context, degrees.get(), place, PROJ_INTERMEDIATE_CRS_USE_ALWAYS);
  if (!to_degrees || rank(context, to_degrees.get()) >= guess_m) return nullptr;
  if (is_geographic(crs)) return to_degrees;
  const PjPtr to_grid{
      proj_create_crs_to_crs_from_pj(context, degrees.get(), crs, nullptr, nullptr)};
  const std::string first = to_steps(context, to_degrees.get()),
                    second = to_grid ? to_steps(context, to_grid.get()) : "";
  if (first.empty() || second.empty()) return nullptr;
  return PjPtr{proj_create(context, ("+proj=pipeline" + first + second).c_str())};
}

}  // namespace

PjPtr find_operation_from_wgs84(PJ_CONTEXT* context, const PJ* crs, const glm::dvec2* place) {
  // Operations through third datums are many (seconds for Japan's) and no better than a direct one,
  // but better than a guess: the old Swiss datum is known by its shift to the later one alone.
  PjPtr best = find_best(context, crs, place, PROJ_INTERMEDIATE_CRS_USE_NEVER);
  if (!best || rank(context, best.get()) >= guess_m)
    if (PjPtr through =
            find_best(context, crs, place, PROJ_INTERMEDIATE_CRS_USE_IF_NO_DIRECT_TRANSFORMATION))
      best = std::move(through);
  if (best && rank(context, best.get()) >= guess_m)
    if (PjPtr made = find_through_degrees(context, crs, place)) best = std::move(made);
  if (best) return best;
  const PjPtr wgs84{proj_create(context, "OGC:CRS84")};
  return wgs84 ? PjPtr{proj_create_crs_to_crs_from_pj(context, wgs84.get(), crs, nullptr, nullptr)}
               : nullptr;
}

bool is_guess(PJ_CONTEXT* context, const PJ* operation) {
  return proj_coordoperation_has_ballpark_transformation(context, operation) != 0;
}

std::string describe_operation(PJ_CONTEXT* context, const PJ* operation) {
  const char* name = proj_get_name(operation);
  std::string text = name && *name ? name : "chosen place by place";
  if (text == "PROJ-based coordinate operation") text = "through other datums";
  const double accuracy = proj_coordoperation_get_accuracy(context, operation);
  char number[48] = ", accuracy not stated";
  if (accuracy >= 0) std::snprintf(number, sizeof number, ", accuracy %g m", accuracy);
  return text + number;
}

}  // namespace nightcity::georeference
