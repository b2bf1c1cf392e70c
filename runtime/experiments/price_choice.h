// The choice of what a model can do without: the parts that cost most for the error that they
// avoid.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace nightcity::experiments {

/// A simplification of the model: a part left out, or light that bounces less often.
struct Cut {
  std::string group;  // at most one cut of a group is made; "" = the cut belongs to no group
  // The error of this cut alone. Root mean squares and means of several cuts together are at most
  // the sum of those of each.
  double error = 0;
  double saving = 0;  // share of the whole price that it saves, 0 .. 1
};

struct Trial {
  std::vector<std::size_t> cuts;  // ascending
  double error = 0;               // measured with all of them
  bool is_kept = false;           // the error is within the limit
  bool is_verification = false;   // of the final set, with random numbers of its own
};

struct CutChoice {
  std::vector<std::size_t> cuts;  // ascending
  double error = 0;               // of the verification; 0 without cuts
  std::vector<Trial> trials;      // in the order in which they were made
};

/// Measures the error with these cuts. For a verification it draws other random numbers than
/// before: the trials chose the set, so that they favour one whose noise makes it look good.
using MeasureCuts =
    std::function<double(const std::vector<std::size_t>& cuts, bool is_verification)>;

/// Returns a set of cuts whose error is at most `limit` in a verification. Cuts that save nothing
/// are not made. The others are tried in rising order of error by saving: first all those together
/// whose errors sum up to at most `limit`, then one more at a time. A set that does not hold in the
/// verification loses the cut that came last.
CutChoice choose_cuts(const std::vector<Cut>& cuts, double limit, const MeasureCuts& measure);

}  // namespace nightcity::experiments
