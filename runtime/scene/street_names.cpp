#include "runtime/scene/street_names.h"

#include <algorithm>
#include <compare>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "runtime/scene/fold_name.h"

namespace nightcity::scene {
namespace {

constexpr int no_match = 4;

// Returns 0 for the name itself, up to 3 for one that contains the text somewhere.
int rank_name(const std::string& name, const std::string& text) {
  const std::size_t at = name.find(text);
  if (at == std::string::npos) return no_match;
  if (at == 0) return name.size() == text.size() ? 0 : 1;
  return name.find(" " + text) != std::string::npos ? 2 : 3;
}

double find_length(const NamedStreet& street) {
  double length = 0;
  for (const auto& line : street.lines)
    for (std::size_t i = 1; i < line.size(); ++i) length += glm::distance(line[i - 1], line[i]);
  return length;
}

// The best comes first in the order of these members.
struct Hit {
  int rank;
  bool is_other_name;
  std::size_t letters;
  std::string name;
  double minus_length_m;
  std::size_t street;
  auto operator<=>(const Hit&) const = default;
};

}  // namespace

std::vector<std::size_t> find_streets(std::span<const NamedStreet> streets,
                                      const std::string& text) {
  const std::string wanted = fold_name(text);
  if (wanted.empty()) return {};
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < streets.size(); ++i) {
    std::optional<Hit> best;
    const auto look_at = [&](const std::string& written, bool is_other_name) {
      std::string name = fold_name(written);
      const int rank = rank_name(name, wanted);
      if (rank == no_match) return;
      const std::size_t letters = name.size();
      Hit hit{rank, is_other_name, letters, std::move(name), -find_length(streets[i]), i};
      if (!best || hit < *best) best = std::move(hit);
    };
    look_at(streets[i].name, false);
    for (const std::string& other : streets[i].also) look_at(other, true);
    if (best) hits.push_back(std::move(*best));
  }
  std::sort(hits.begin(), hits.end());
  std::vector<std::size_t> found;
  for (const Hit& hit : hits) found.push_back(hit.street);
  return found;
}

}  // namespace nightcity::scene
