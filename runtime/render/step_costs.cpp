#include "runtime/render/step_costs.h"

#include <algorithm>

namespace nightcity::render {
namespace {

// A step of unknown cost begins with this share of its parts.
constexpr std::uint32_t first_share = 64;
// A run holds at most so many times the parts of the one before: a few cheap ones say little of
// the next.
constexpr std::uint32_t max_growth = 8;
// Parts of a step differ: sky costs little, a square full of lamps much. The dearest so far counts,
// and is forgotten by this factor a run. Most runs are then shorter than asked for, and hardly one
// longer by more than half.
constexpr double peak_kept = 0.98, beyond_asked = 1.5;
// A run this short takes the time that a device needs to begin and end, however few its parts: it
// says little of them, and a run of more parts says more.
constexpr double short_s = 0.001;

}  // namespace

void StepCosts::learn(const std::string& step, std::uint32_t count, double seconds) {
  const auto [entry, is_first] = costs_.try_emplace(step);
  Cost& cost = entry->second;
  cost.last = count;
  // The first run of a step compiles on some devices, and says nothing.
  if (is_first) return;
  const double part_s = std::max(seconds, 1e-9) / count;
  const bool says_more = cost.run_s < short_s && count > cost.count;
  const double kept_s = says_more ? 0 : peak_kept * cost.part_s;
  if (part_s >= kept_s) {
    cost.run_s = seconds;
    cost.count = count;
  }
  cost.part_s = std::max(part_s, kept_s);
}

double StepCosts::of_part(const std::string& step) const {
  const auto known = costs_.find(step);
  return known == costs_.end() ? 0 : known->second.part_s;
}

std::uint32_t StepCosts::parts_within(const std::string& step, std::uint32_t parts,
                                      double seconds) const {
  const auto known = costs_.find(step);
  if (known == costs_.end()) return std::max(1u, parts / first_share);
  const Cost& cost = known->second;
  if (cost.part_s <= 0) return std::min(cost.last, parts);
  const double fitting =
      std::min(beyond_asked * seconds / cost.part_s, double(max_growth) * double(cost.last));
  return std::clamp(static_cast<std::uint32_t>(std::min(fitting, double(parts))), 1u, parts);
}

double StepCosts::expect(const std::string& step, std::uint32_t count) const {
  return of_part(step) * count / beyond_asked;
}

}  // namespace nightcity::render
