// One value of a recipe together with its name and line, which every message about it gives.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace nightcity::recipe {

/// A view of a TOML node. Each accessor throws UsageError when the node is not what it asks for.
struct Value {
  const std::string& file;
  std::string name;  // "[city] tile_m"
  const toml::node& node;

  /// Throws UsageError: "FILE: line N: NAME MESSAGE".
  [[noreturn]] void refuse(const std::string& message) const;

  /// Prints "note: FILE:N: NAME MESSAGE" on stderr.
  void note(const std::string& message) const;

  /// Returns a number within [min, max]; NaN is never within.
  double number(double min, double max) const;
  int integer(int min, int max) const;
  bool boolean() const;
  std::string text() const;
  /// Returns the strings of a list; a single string counts as a list of one.
  std::vector<std::string> texts() const;
  /// Returns the path that a string names, from `folder`. Refuses addresses of the web and what
  /// stands for a folder on other systems; a file that is not there is for its reader to tell.
  std::filesystem::path path(const std::filesystem::path& folder) const;
  /// Returns those of a list; a single string counts as a list of one.
  std::vector<std::filesystem::path> paths(const std::filesystem::path& folder) const;

  /// Returns the elements of a list that has exactly `count` of them (0: any number). Refuses with
  /// "is not WHAT" otherwise.
  std::vector<Value> elements(std::size_t count, const std::string& what) const;
  /// Returns the rows of a table, each named "NAME.ROW", in the order of their names. Refuses with
  /// "is not WHAT" when the node is no table.
  std::vector<std::pair<std::string, Value>> rows(const std::string& what) const;
};

/// Returns `value` without trailing zeros: "250", "0.01".
std::string to_short_text(double value);

}  // namespace nightcity::recipe
