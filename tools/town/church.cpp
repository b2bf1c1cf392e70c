#include "tools/town/church.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nightcity::town {

using glm::dvec2;

void plan_church(BlockSite& site) {
  const dvec2 centre = (site.parcel[0] + site.parcel[1] + site.parcel[2] + site.parcel[3]) / 4.0;
  const double half = 7, length = 30;
  const dvec2 u = site.sides[0].along, v = site.sides[0].inward;
  BuildingPlan nave = make_rectangle(centre - u * (length / 2) - v * half, u, length, 2 * half);
  nave.function = "31001_3041";
  nave.year = site.random.integer(1250, 1500);
  nave.storeys = 1;
  site.stand(nave, 13, 0.5);
  site.roof_over(nave, Roof::gabled, 2 * half, 56);

  BuildingPlan tower = make_rectangle(centre - u * (length / 2 + 8) - v * 4.0, u, 8, 8);
  site.stand(tower, 32, 0.5);
  tower.roof = Roof::pyramid;
  tower.ridge_m = tower.eave_m + 24;

  BuildingPlan apse;
  apse.shape = Shape::apse;
  const dvec2 east = centre + u * (length / 2);
  for (int n = 0; n <= 6; ++n) {
    // From the north end of the nave's gable by the east to the south end, then counter-clockwise
    // again.
    const double angle = -std::numbers::pi / 2 + std::numbers::pi * n / 6;
    apse.outline.push_back(east + u * (5.0 * std::cos(angle)) + v * (5.0 * std::sin(angle)));
  }
  std::rotate(apse.outline.begin(), apse.outline.end() - 1,
              apse.outline.end());  // edge 0 on the gable
  site.stand(apse, 9, 0.5);
  apse.ridge_m = apse.eave_m + 4;
  for (BuildingPlan* part : {&tower, &apse}) {
    part->function = nave.function;
    part->year = nave.year;
    nave.parts.push_back(std::move(*part));
  }
  site.plans.push_back(std::move(nave));
}

}  // namespace nightcity::town
