#include "tools/town/building_plan.h"

#include <utility>

#include "tools/town/block_site.h"
#include "tools/town/church.h"
#include "tools/town/open_blocks.h"
#include "tools/town/perimeter_block.h"

namespace nightcity::town {

std::vector<BuildingPlan> plan_block(const StreetPlan& streets, const Hills& hills,
                                     std::uint64_t seed, int i, int j) {
  BlockSite site(streets, hills, seed, i, j);
  switch (streets.use(i, j)) {
    case BlockUse::market:
      plan_church(site);
      break;
    case BlockUse::park:
      break;
    case BlockUse::courtyard:
      plan_courtyard(site);
      break;
    case BlockUse::perimeter:
      if (!plan_perimeter(site)) plan_houses(site);
      break;
    case BlockUse::slabs:
      plan_slabs(site);
      break;
    case BlockUse::hall:
      plan_hall(site);
      break;
    case BlockUse::houses:
      plan_houses(site);
      break;
  }
  return std::move(site.plans);
}

}  // namespace nightcity::town
