#include "tools/trees/leaf_habit.h"

#include <algorithm>
#include <array>
#include <string>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

namespace nightcity::trees {
namespace {

// Genera of A. Roloff and A. Baertels, Flora der Gehoelze (2014), all of whose species have the
// same habit; palms and trees of warm countries besides. Genera of trees that shed broad leaves are
// not listed: it is what is assumed.
constexpr std::array evergreen_needles{
    "abies",        "araucaria",      "calocedrus",     "cedrus",
    "cephalotaxus", "chamaecyparis",  "cryptomeria",    "cupressocyparis",
    "cupressus",    "hesperocyparis", "juniperus",      "picea",
    "pinus",        "podocarpus",     "platycladus",    "pseudotsuga",
    "sciadopitys",  "sequoia",        "sequoiadendron", "taxus",
    "thuja",        "thujopsis",      "tsuga"};
constexpr std::array shed_needles{"glyptostrobus", "larix", "metasequoia", "pseudolarix",
                                  "taxodium"};
constexpr std::array evergreen_leaves{
    "buxus",   "casuarina", "ceratonia", "chamaerops",   "citrus",      "cocos", "eucalyptus",
    "laurus",  "livistona", "nerium",    "olea",         "phoenix",     "sabal", "syagrus",
    "arbutus", "camellia",  "roystonea", "trachycarpus", "washingtonia"};
// Species that stay green in genera of which others shed their leaves.
constexpr std::array evergreen_species{"ilex aquifolium",     "magnolia grandiflora",
                                       "prunus laurocerasus", "prunus lusitanica",
                                       "quercus ilex",        "quercus suber"};
// Common names in English, as words, and in German, where they end words such as "Waldkiefer".
constexpr std::array evergreen_words{"pine",    "spruce",  "fir",   "yew",     "cedar",  "cypress",
                                     "juniper", "hemlock", "thuja", "redwood", "conifer"};
constexpr std::array evergreen_endings{"fichte",     "kiefer",    "tanne",        "eibe",
                                       "zeder",      "wacholder", "f\xc3\xb6hre", "zypresse",
                                       "lebensbaum", "douglasie"};
constexpr std::array shed_endings{"larch", "l\xc3\xa4rche", "laerche"};

template <class Table>
bool holds(const Table& table, std::string_view word) {
  return std::find(table.begin(), table.end(), word) != table.end();
}

template <class Table>
bool ends_as_one(const Table& table, std::string_view word) {
  return std::any_of(table.begin(), table.end(),
                     [&](std::string_view ending) { return word.ends_with(ending); });
}

// Finds a common name among the words of a text in lower case.
std::optional<LeafHabit> find_common_name(std::string_view text) {
  constexpr std::string_view between = " _,;()-/'\"";
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(between), text.size());
    const std::string_view word = text.substr(0, end);
    if (ends_as_one(shed_endings, word)) return LeafHabit{true, false};
    if (holds(evergreen_words, word) || ends_as_one(evergreen_endings, word))
      return LeafHabit{true, true};
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

}  // namespace

std::optional<LeafHabit> find_leaf_habit(std::string_view species) {
  const std::string text = to_lower(city::trim(species));
  const std::string_view genus = std::string_view(text).substr(0, text.find_first_of(" _,;"));
  if (holds(evergreen_needles, genus)) return LeafHabit{true, true};
  if (holds(shed_needles, genus)) return LeafHabit{true, false};
  if (holds(evergreen_leaves, genus)) return LeafHabit{false, true};
  for (const std::string_view name : evergreen_species)
    if (text.starts_with(name)) return LeafHabit{false, true};
  if (text.find("conifer") != std::string::npos) return LeafHabit{true, true};
  if (text.find("deciduous") != std::string::npos) return LeafHabit{false, false};
  return find_common_name(text);
}

}  // namespace nightcity::trees
