#include "tools/bridges/deck_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nightcity::bridges {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class ProfileFinder {
 public:
  ProfileFinder(const DeckCourse& course, const DeckRules& rules)
      : course_(course),
        rules_(rules),
        step_m_(course.length_m / static_cast<double>(course.ground_m.size() - 1)),
        needs_m_(course.ground_m.size(), -infinity) {
    for (const auto& ground : course.ground_m) note_lowest(ground);
    note_lowest(course.first_m);
    note_lowest(course.last_m);
  }

  std::optional<DeckProfile> find(std::string& reason) {
    if (course_.first_m && course_.last_m &&
        std::abs(*course_.last_m - *course_.first_m) > rules_.max_gradient * course_.length_m) {
      reason = "steeper than allowed from end to end";
      return std::nullopt;
    }
    for (const Clearance& clearance : course_.clearances)
      if (!raise_over(clearance)) {
        reason = "too short to rise above what it crosses";
        return std::nullopt;
      }
    for (std::size_t i = 0; i < needs_m_.size(); ++i)
      if (const auto ground = course_.ground_m[i])
        needs_m_[i] = std::max(needs_m_[i], std::min(*ground, find_limit(at(i), false)));
    fix_ends();
    profile_.heights_m = pull_taut();
    if (!std::isfinite(profile_.heights_m.front())) {
      reason = "no ground below";
      return std::nullopt;
    }
    return std::move(profile_);
  }

 private:
  void note_lowest(const std::optional<double>& height_m) {
    lowest_m_ = std::min(lowest_m_, height_m.value_or(infinity));
  }

  double at(std::size_t i) const { return static_cast<double>(i) * step_m_; }

  // Returns the greatest height at a place that the gradient allows from the ends: of a point, or
  // of the top of a crest, which the steepest line from an end touches.
  double find_limit(double s, bool is_crest) const {
    double limit_m = infinity;
    const auto limit = [&](const std::optional<double>& end, double away_m) {
      if (!end) return;
      const double g = rules_.max_gradient, r = rules_.crest_radius_m;
      double rise_m = g * away_m;
      if (is_crest) rise_m = away_m < r * g ? away_m * away_m / (2 * r) : rise_m - r * g * g / 2;
      limit_m = std::min(limit_m, *end + rise_m);
    };
    limit(course_.first_m, s);
    limit(course_.last_m, course_.length_m - s);
    return limit_m;
  }

  bool raise_over(const Clearance& clearance) {
    const double from = std::clamp(clearance.from_m, 0.0, course_.length_m),
                 to = std::clamp(clearance.to_m, 0.0, course_.length_m);
    const double limit_m = std::min(find_limit(from, true), find_limit(to, true));
    const double height_m = std::min(clearance.height_m, limit_m);
    if (height_m < clearance.least_m) return false;
    constexpr double slack_m = 1e-6;
    profile_.is_low |= height_m < clearance.height_m - slack_m;
    // Farther away the crest is lower than all ground.
    const double reach_m =
        std::sqrt(2 * rules_.crest_radius_m * std::max(0.0, height_m - lowest_m_));
    for (std::size_t i = find_place(from - reach_m); i <= find_place(to + reach_m); ++i) {
      const double away_m = std::max({from - at(i), at(i) - to, 0.0});
      needs_m_[i] = std::max(needs_m_[i], height_m - away_m * away_m / (2 * rules_.crest_radius_m));
    }
    return true;
  }

  // Returns the number of the place nearest to a distance from the start.
  std::size_t find_place(double s) const {
    const auto last = static_cast<double>(needs_m_.size() - 1);
    return static_cast<std::size_t>(std::clamp(std::round(s / step_m_), 0.0, last));
  }

  void fix_ends() {
    const double highest_m = *std::max_element(needs_m_.begin(), needs_m_.end());
    needs_m_.front() =
        course_.first_m.value_or(std::max(highest_m, course_.last_m.value_or(-infinity)));
    needs_m_.back() =
        course_.last_m.value_or(std::max(highest_m, course_.first_m.value_or(-infinity)));
  }

  // Returns the upper convex hull of the needs.
  std::vector<double> pull_taut() const {
    std::vector<std::size_t> hull;
    const auto lies_below = [&](std::size_t a, std::size_t b, std::size_t c) {
      return (needs_m_[b] - needs_m_[a]) * static_cast<double>(c - a) <=
             (needs_m_[c] - needs_m_[a]) * static_cast<double>(b - a);
    };
    for (std::size_t i = 0; i < needs_m_.size(); ++i) {
      if (!std::isfinite(needs_m_[i])) continue;
      while (hull.size() > 1 && lies_below(hull[hull.size() - 2], hull.back(), i)) hull.pop_back();
      hull.push_back(i);
    }
    std::vector<double> heights(needs_m_.size(), -infinity);
    for (std::size_t h = 0; h + 1 < hull.size(); ++h)
      for (std::size_t i = hull[h]; i <= hull[h + 1]; ++i)
        heights[i] = std::lerp(
            needs_m_[hull[h]], needs_m_[hull[h + 1]],
            static_cast<double>(i - hull[h]) / static_cast<double>(hull[h + 1] - hull[h]));
    return heights;
  }

  const DeckCourse& course_;
  const DeckRules& rules_;
  double step_m_;
  double lowest_m_ = infinity;   // of ground and ends
  std::vector<double> needs_m_;  // the least height of the deck at each place
  DeckProfile profile_;
};

}  // namespace

std::optional<DeckProfile> find_profile(const DeckCourse& course, const DeckRules& rules,
                                        std::string& reason) {
  return ProfileFinder(course, rules).find(reason);
}

}  // namespace nightcity::bridges
