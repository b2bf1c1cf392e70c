#include "tools/bake/scene/hierarchies.h"

#include <vector>

#include "formats/hierarchy/static_builder.h"
#include "formats/light_file.h"
#include "formats/parallel.h"
#include "formats/stored_hierarchy_writer.h"

namespace nightcity::bake {

HierarchyReport add_hierarchies(const std::filesystem::path& glb,
                                const std::filesystem::path& lights, unsigned threads) {
  const bool has_traffic = !LightFile::open(lights).traffic().trips.empty();
  const auto built =
      hierarchy::build_static_hierarchies(glb, has_traffic, threads > 0 ? threads : count_cores());
  HierarchyReport report;
  std::vector<StoredHierarchy> described;
  for (const hierarchy::BuiltHierarchy& one : built) {
    described.push_back(one.description);
    report.triangles += one.description.triangles;
    report.nodes += one.encoded.topology.size();
    report.bytes += one.description.topology.size() + one.description.order.size() +
                    one.description.cuts.size();
  }
  if (described.empty() || !store_hierarchies(glb, described)) return {};
  return report;
}

}  // namespace nightcity::bake
