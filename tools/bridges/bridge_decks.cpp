#include "tools/bridges/bridge_decks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "tools/mesh/owner_finder.h"

namespace nightcity::bridges {
namespace {

// Mitred corners of an outline lie at most twice as far from the line as its sides.
constexpr double mitre_limit = 2;
constexpr double beside_m = 1.0;    // what stands as near to a deck stands on it
constexpr double railing_m = 0.35;  // from the edge: what stands on a deck stands within it

double find_reach_m(const Deck& deck) {
  return mitre_limit * deck.half_m + beside_m;
}

}  // namespace

double Deck::height_at(double s) const {
  const auto last = static_cast<double>(heights_m.size() - 1);
  const double at = std::clamp(s / length_m() * last, 0.0, last);
  const double before = std::min(std::floor(at), last - 1);
  const auto i = static_cast<std::size_t>(before);
  return std::lerp(heights_m[i], heights_m[i + 1], at - before);
}

Deck::Foot Deck::project(const glm::dvec2& place) const {
  Foot best{0, std::numeric_limits<double>::infinity(), line.front(), false};
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec2 along = line[i + 1] - line[i];
    const double length_m = at_m[i + 1] - at_m[i];
    if (!(length_m > 0)) continue;
    const double share = glm::dot(place - line[i], along) / (length_m * length_m);
    const glm::dvec2 point = line[i] + along * std::clamp(share, 0.0, 1.0);
    const double away_m = glm::distance(place, point);
    if (away_m >= best.away_m) continue;
    constexpr double slack = 1e-9;
    const bool beyond = (i == 0 && share < -slack) || (i + 2 == line.size() && share > 1 + slack);
    best = {at_m[i] + std::clamp(share, 0.0, 1.0) * length_m, away_m, point, beyond};
  }
  return best;
}

void BridgeDecks::add(Deck deck) {
  deck.box = ground_cover::find_box({deck.line});
  deck.box.low -= find_reach_m(deck);
  deck.box.high += find_reach_m(deck);
  index_.add(static_cast<std::uint32_t>(decks_.size()), deck.box);
  decks_.push_back(std::move(deck));
}

const BridgeDecks::Lifted* BridgeDecks::find(std::int64_t way_id) const {
  const auto found = lifted_.find(way_id);
  return found == lifted_.end() ? nullptr : &found->second;
}

// Franke and Nielson 1980: the mean of the decks within reach, weighed by ((reach - away) / (reach
// away))^2. A deck's own line has its own height.
std::optional<double> BridgeDecks::height_at(int layer, const glm::dvec2& place) const {
  double sum = 0, weights = 0;
  for (const std::uint32_t number : index_.find({place, place})) {
    const Deck& deck = decks_[number];
    if (deck.layer != layer || !deck.box.holds(place)) continue;
    const Deck::Foot foot = deck.project(place);
    const double reach_m = find_reach_m(deck);
    if (foot.away_m >= reach_m) continue;
    constexpr double nearest_m = 1e-6;
    if (foot.away_m < nearest_m) return deck.height_at(foot.at_m);
    const double root = (reach_m - foot.away_m) / (reach_m * foot.away_m);
    sum += root * root * deck.height_at(foot.at_m);
    weights += root * root;
  }
  return weights > 0 ? std::optional(sum / weights) : std::nullopt;
}

std::optional<glm::dvec3> BridgeDecks::find_place(std::int64_t way_id,
                                                  const glm::dvec2& place) const {
  const Lifted* lifted = find(way_id);
  if (!lifted) return std::nullopt;
  const Deck& deck = decks_[lifted->deck];
  const Deck::Foot foot = deck.project(place);
  if (foot.is_beyond || foot.away_m > deck.half_m + beside_m) return std::nullopt;
  const double most_m = deck.half_m - railing_m;
  const glm::dvec2 kept =
      foot.away_m > most_m ? foot.point + (place - foot.point) * (most_m / foot.away_m) : place;
  const auto height = height_at(deck.layer, kept);
  return height ? std::optional(glm::dvec3(kept, *height)) : std::nullopt;
}

std::optional<double> BridgeDecks::find_soffit(const glm::dvec3& place) const {
  std::optional<double> lowest;
  const glm::dvec2 plan(place);
  for (const std::uint32_t number : index_.find({plan, plan})) {
    const Deck& deck = decks_[number];
    if (!deck.box.holds(plan) || !mesh::holds(deck.outline, plan)) continue;
    const auto top = height_at(deck.layer, plan);
    constexpr double slack_m = 0.5;  // what stands on a deck is not below it
    if (!top || *top < place.z + slack_m) continue;
    lowest = std::min(lowest.value_or(*top - deck_m), *top - deck_m);
  }
  return lowest;
}

bool BridgeDecks::covers(const glm::dvec2& place) const {
  for (const std::uint32_t number : index_.find({place, place}))
    if (decks_[number].box.holds(place) && mesh::holds(decks_[number].outline, place)) return true;
  return false;
}

}  // namespace nightcity::bridges
