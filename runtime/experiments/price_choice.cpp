#include "runtime/experiments/price_choice.h"

#include <algorithm>

namespace nightcity::experiments {
namespace {

// Returns the cuts that save something and keep the limit alone, the most worthwhile first.
std::vector<std::size_t> order_cuts(const std::vector<Cut>& cuts, double limit) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (cuts[i].saving > 0 && cuts[i].error <= limit) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double of_a = cuts[a].error * cuts[b].saving, of_b = cuts[b].error * cuts[a].saving;
    return of_a != of_b ? of_a < of_b : cuts[a].saving > cuts[b].saving;
  });
  return order;
}

class Chooser {
 public:
  Chooser(const std::vector<Cut>& cuts, double limit, const MeasureCuts& measure)
      : cuts_(cuts), limit_(limit), measure_(measure) {}

  CutChoice run() {
    std::vector<std::size_t> order = order_cuts(cuts_, limit_);
    start(order);
    for (const std::size_t cut : order)
      if (!is_made(cut)) add_if_kept(cut);
    while (!made_.empty() && !is_kept(made_, true)) made_.pop_back();
    choice_.error = made_.empty() ? 0 : choice_.trials.back().error;
    choice_.cuts = sorted(made_);
    return choice_;
  }

 private:
  static std::vector<std::size_t> sorted(std::vector<std::size_t> cuts) {
    std::sort(cuts.begin(), cuts.end());
    return cuts;
  }

  bool is_made(std::size_t cut) const {
    return std::find(made_.begin(), made_.end(), cut) != made_.end();
  }

  // Returns the cuts that are made, with one more in place of that of its group.
  std::vector<std::size_t> with(std::size_t cut) const {
    std::vector<std::size_t> more = made_;
    if (!cuts_[cut].group.empty())
      std::erase_if(more,
                    [&](std::size_t other) { return cuts_[other].group == cuts_[cut].group; });
    more.push_back(cut);
    return more;
  }

  // Returns whether another cut of the same group that saves at least as much is made.
  bool is_surpassed(std::size_t cut) const {
    return !cuts_[cut].group.empty() &&
           std::any_of(made_.begin(), made_.end(), [&](std::size_t other) {
             return cuts_[other].group == cuts_[cut].group &&
                    cuts_[other].saving >= cuts_[cut].saving;
           });
  }

  bool is_kept(const std::vector<std::size_t>& cuts, bool is_verification) {
    const double error = measure_(sorted(cuts), is_verification);
    choice_.trials.push_back({sorted(cuts), error, error <= limit_, is_verification});
    return error <= limit_;
  }

  // Makes the first cuts whose errors sum up to the limit, as far as they keep it together.
  void start(const std::vector<std::size_t>& order) {
    for (const std::size_t cut : order) {
      if (is_surpassed(cut)) continue;
      const std::vector<std::size_t> more = with(cut);
      double error = 0;
      for (const std::size_t each : more) error += cuts_[each].error;
      if (error <= limit_) made_ = more;
    }
    while (made_.size() > 1 && !is_kept(made_, false)) {
      rejected_.push_back(made_.back());
      made_.pop_back();
    }
  }

  void add_if_kept(std::size_t cut) {
    if (is_surpassed(cut) || std::find(rejected_.begin(), rejected_.end(), cut) != rejected_.end())
      return;
    if (const std::vector<std::size_t> more = with(cut); is_kept(more, false)) made_ = more;
  }

  const std::vector<Cut>& cuts_;
  double limit_;
  const MeasureCuts& measure_;
  std::vector<std::size_t> made_;      // in the order in which they were made
  std::vector<std::size_t> rejected_;  // were tried and did not keep the limit
  CutChoice choice_;
};

}  // namespace

CutChoice choose_cuts(const std::vector<Cut>& cuts, double limit, const MeasureCuts& measure) {
  return Chooser(cuts, limit, measure).run();
}

}  // namespace nightcity::experiments
