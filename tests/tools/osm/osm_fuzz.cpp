// libFuzzer target: reads any bytes as an OSM extract, in the format that their first bytes show.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "formats/error.h"
#include "support/fuzz_file.h"
#include "tests/tools/osm/mutate_map.h"
#include "tools/osm/read_osm.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  const test::FuzzFile file(data, size);
  const auto on_earth = [](const glm::dvec2& p) {
    return std::abs(p.x) <= 180 && std::abs(p.y) <= 90;
  };
  try {
    const osm::OsmData osm = osm::read_osm(file.path());
    for (const osm::OsmLampNode& lamp : osm.lamps)
      if (!on_earth(lamp.lon_lat)) std::abort();
    for (const auto* ways : {&osm.highways, &osm.buildings})
      for (const osm::OsmWay& way : *ways)
        for (const glm::dvec2& p : way.lon_lat)
          if (!on_earth(p)) std::abort();
  } catch (const Error&) {  // a broken file
  }
  return 0;
}
