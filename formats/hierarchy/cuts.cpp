#include "formats/hierarchy/cuts.h"

#include <cmath>
#include <cstring>

#include "formats/hierarchy/polygon.h"

namespace nightcity::hierarchy {
namespace {

// Coordinates of a part are rounded to floats, by less than this of themselves.
constexpr float rounding = 0x1p-22f;

Bounds widen(const Bounds& part, const Bounds& within) {
  const Float4 size = max_of(max_of(part.upper, -part.lower), max_of(part.lower, -part.upper));
  return {max_of(part.lower - rounding * size, within.lower),
          min_of(part.upper + rounding * size, within.upper)};
}

}  // namespace

std::optional<std::pair<Bounds, Bounds>> cut_box(const Corners& triangle, const Bounds& box,
                                                 int axis, float plane_m) {
  Polygon above(triangle);
  above.keep_inside(box);
  const Polygon below = above.cut_off_below(axis, double(plane_m));
  if (below.empty() || above.empty()) return std::nullopt;
  const Bounds low = below.bounds(), high = above.bounds();
  if (!(low.lower[axis] < plane_m && plane_m < high.upper[axis])) return std::nullopt;
  return std::pair(widen(low, box), widen(high, box));
}

std::string decode_cuts(std::span<const std::byte> bytes, std::uint32_t triangles,
                        std::vector<Cut>& cuts) {
  cuts.clear();
  if (bytes.size() % sizeof(Cut) != 0) return "its cuts end within one";
  const std::size_t count = bytes.size() / sizeof(Cut);
  if (count > triangles) return "it has more cuts than triangles";
  if (triangles + 2 * std::uint64_t{count} > most_parts) return "it has too many parts";
  cuts.resize(count);
  if (count > 0) std::memcpy(cuts.data(), bytes.data(), bytes.size());
  std::vector<bool> is_cut(triangles + 2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    const Cut& cut = cuts[k];
    if (cut.part >= triangles + 2 * k) return "a cut is of a part that is not there";
    if (is_cut[cut.part]) return "a part is cut twice";
    if (cut.axis > 2 || !std::isfinite(cut.plane_m)) return "a cut has no plane";
    is_cut[cut.part] = true;
  }
  return "";
}

}  // namespace nightcity::hierarchy
