// The table of `nightview sweep`, which survives an interruption, and its plot.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/measure/plot.h"
#include "runtime/measure/table.h"

namespace nightcity::experiments {

/// sweep.csv in a folder: keeps the rows of earlier runs on the same scene and adds new ones.
class SweepTable {
 public:
  /// The first `key_columns` of `columns` identify a row. Where an earlier run left another
  /// `fingerprint` of the scene, its rows and reference pictures are removed and `restarted()`
  /// returns true. Throws Error when the folder cannot be written to or its table has other
  /// columns.
  SweepTable(std::filesystem::path folder, const std::string& fingerprint,
             std::vector<std::string> columns, std::size_t key_columns);

  bool restarted() const { return restarted_; }
  /// Returns whether there is a row that begins with `key`.
  bool holds(const std::vector<std::string>& key) const;
  /// Adds a row and writes the file.
  void add(std::vector<std::string> row);
  const measure::Table& table() const { return table_; }

 private:
  std::filesystem::path folder_;
  std::size_t key_columns_;
  measure::Table table_;
  bool restarted_ = false;
};

/// Returns a plot of relative MSE against milliseconds with one line per estimator, from the rows
/// of `view` that average the most frames.
measure::Plot make_sweep_plot(const measure::Table& table, const std::string& view);

}  // namespace nightcity::experiments
