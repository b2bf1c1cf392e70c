// Probabilities of what an alias table draws.
#pragma once

#include <span>
#include <vector>

#include "shaders/interface.h"

namespace nightcity::test {

/// Returns the probability of each index, summed over the columns that give it.
inline std::vector<double> find_probabilities(std::span<const gpu::AliasEntry> table) {
  std::vector<double> p(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    p[i] += double(table[i].keep) / double(table.size());
    p[table[i].alias] += (1.0 - double(table[i].keep)) / double(table.size());
  }
  return p;
}

}  // namespace nightcity::test
