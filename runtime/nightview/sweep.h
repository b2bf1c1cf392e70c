// The loop of `nightview sweep`: every combination of the knobs' values on every view, into a table that
// survives being stopped.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "runtime/measure/plot.h"
#include "runtime/measure/table.h"
#include "runtime/nightview/knobs.h"

namespace nightcity {

/// One setting of every knob, by its name.
using KnobValues = std::map<std::string, std::string>;

/// Every combination, the first knob slowest. `chosen` holds comma-separated lists by knob name; knobs
/// without one keep their defaults. Throws UsageError on a value that a knob does not take. The paper's
/// estimator picks uniformly whatever the shares say and `ris` reuses no neighbour: combinations that differ
/// in such a knob alone come once.
std::vector<KnobValues> combinations(const std::map<std::string, std::string>& chosen);

RenderSettings settings_of(const KnobValues& values);

/// sweep.csv in `folder`: rows kept from runs before on the same scene, added to one by one.
class SweepTable {
 public:
  /// `fingerprint` of the scene: where that of an earlier run differs, its rows and reference pictures are
  /// removed and `restarted()` says so.
  SweepTable(std::filesystem::path folder, const std::string& fingerprint,
             std::vector<std::string> columns, std::size_t key_columns);

  bool restarted() const { return restarted_; }
  /// Is there a row that begins with `key`?
  bool holds(const std::vector<std::string>& key) const;
  /// Written to the file at once.
  void add(std::vector<std::string> row);
  const Table& table() const { return table_; }

 private:
  std::filesystem::path folder_;
  std::size_t key_columns_;
  Table table_;
  bool restarted_ = false;
};

/// Relative MSE against milliseconds, one line an estimator, of the table's rows with the most frames in view
/// `view`.
Plot sweep_plot(const Table& table, const std::string& view);

}  // namespace nightcity
