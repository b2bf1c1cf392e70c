#include "tools/trees/leaf_habit.h"

#include <algorithm>
#include <array>
#include <string>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

namespace nightcity::trees {
namespace {

// Genera of A. Roloff and A. Baertels, Flora der Gehoelze (2014), all of whose species have the
// same habit. Genera of trees that shed broad leaves are not listed: it is what is assumed.
constexpr std::array evergreen_needles{
    "abies",       "araucaria",   "cedrus",      "cephalotaxus", "chamaecyparis",
    "cryptomeria", "cupressus",   "juniperus",   "picea",        "pinus",
    "platycladus", "pseudotsuga", "sciadopitys", "sequoia",      "sequoiadendron",
    "taxus",       "thuja",       "thujopsis",   "tsuga"};
constexpr std::array shed_needles{"glyptostrobus", "larix", "metasequoia", "pseudolarix",
                                  "taxodium"};
constexpr std::array evergreen_leaves{"buxus", "eucalyptus", "laurus", "olea"};

template <class Table>
bool holds(const Table& table, std::string_view word) {
  return std::find(table.begin(), table.end(), word) != table.end();
}

}  // namespace

std::optional<LeafHabit> find_leaf_habit(std::string_view species) {
  const std::string text = to_lower(city::trim(species));
  const std::string_view genus = std::string_view(text).substr(0, text.find_first_of(" _,;"));
  if (holds(evergreen_needles, genus)) return LeafHabit{true, true};
  if (holds(shed_needles, genus)) return LeafHabit{true, false};
  if (holds(evergreen_leaves, genus)) return LeafHabit{false, true};
  if (text.find("conifer") != std::string::npos) return LeafHabit{true, true};
  if (text.find("deciduous") != std::string::npos) return LeafHabit{false, false};
  return {};
}

}  // namespace nightcity::trees
