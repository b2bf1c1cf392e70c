#include "tools/bake/scene/map_models.h"

#include <utility>
#include <vector>

#include "tools/bake/city/obstacles.h"
#include "tools/barriers/barrier_shape.h"
#include "tools/barriers/find_barriers.h"
#include "tools/steps/find_steps.h"
#include "tools/steps/flight_shape.h"

namespace nightcity::bake {

void add_barrier_models(const City& city, const terrain::Extent& extent, SceneTiles& tiles,
                        BarriersReport& report) {
  barriers::BarrierSet found =
      barriers::find_barriers(city.map(), city.cover(), {extent.low, extent.high}, city.to_frame(),
                              city.height_at(), find_obstacles(city));
  const auto add = [&](const auto& barrier) {
    const std::vector<barriers::Corners> surface = barriers::make_shape(barrier);
    report.triangles += surface.size();
    tiles.add_barrier(surface, barrier.kind.material);
  };
  for (const barriers::BarrierLine& line : found.lines) add(line);
  for (const barriers::BarrierArea& area : found.areas) add(area);
  report.found = std::move(found.report);
}

void add_step_models(const City& city, const terrain::Extent& extent, SceneTiles& tiles,
                     FlightsReport& report) {
  steps::StepSet found =
      steps::find_steps(city.map().highways, city.cover(), {extent.low, extent.high},
                        city.to_frame(), city.height_at(), find_obstacles(city));
  for (const steps::Flight& flight : found.flights) {
    const std::vector<steps::Corners> surface = steps::make_shape(flight);
    report.triangles += surface.size();
    tiles.add_steps(surface, flight.surface);
  }
  report.found = std::move(found.report);
}

}  // namespace nightcity::bake
