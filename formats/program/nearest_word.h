// Finds the word that a user probably meant.
#pragma once

#include <string>
#include <vector>

namespace nightcity::program {

/// Returns the candidate with the fewest edits from `word`: insertions, deletions, replacements and
/// swaps of neighbours (Damerau-Levenshtein distance, optimal string alignment). Returns "" when
/// every candidate needs more edits than half of the letters of `word`, and more than two.
std::string find_nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace nightcity::program
