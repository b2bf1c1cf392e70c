// The table of `nightview sweep`, which survives an interruption, and its plot.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/measure/plot.h"
#include "runtime/measure/table.h"

namespace nightcity::experiments {

/// sweep.csv in a folder: keeps the rows of earlier runs on the same scene and adds new ones.
class SweepTable {
 public:
  /// The first `key_columns` of `columns` identify a row. Where an earlier run left another
  /// `fingerprint` of the scene, its rows and reference pictures are removed and `restarted()`
  /// returns true. A table that lacks the last columns, of an older version, gets them, empty.
  /// Throws Error when the folder cannot be written to or its table has other columns.
  SweepTable(std::filesystem::path folder, const std::string& fingerprint,
             std::vector<std::string> columns, std::size_t key_columns);

  bool restarted() const { return restarted_; }
  /// Returns whether there is a row that begins with `key`.
  bool holds(const std::vector<std::string>& key) const;
  /// Adds a row and writes the file.
  void add(std::vector<std::string> row);
  /// Sets the column "front": "yes" in rows on the Pareto front of their view, size, device and
  /// number of frames, else "no". Writes the file.
  void mark_front();
  const measure::Table& table() const { return table_; }

 private:
  std::filesystem::path folder_;
  std::size_t key_columns_;
  measure::Table table_;
  bool restarted_ = false;
};

/// Returns which points are on the Pareto front: no other point is as good in both values and
/// better in one, where less is better. Equal points are on it together. NaN is on no front.
std::vector<bool> find_front(const std::vector<std::pair<double, double>>& points);

/// Returns the table as JSON: a list of objects by column, with numbers as numbers, a front as true
/// or false, and null for what was not measured.
std::string to_json(const measure::Table& table);

/// Returns a plot of relative MSE against milliseconds with one line per estimator and one along
/// the Pareto front, from the rows of `view` that average the most frames.
measure::Plot make_sweep_plot(const measure::Table& table, const std::string& view);

}  // namespace nightcity::experiments
