#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "tools/bridges/bridge_decks.h"
#include "tools/bridges/clearances.h"
#include "tools/bridges/crossed_ways.h"
#include "tools/bridges/placed_map.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/widened_line.h"
#include "tools/osm/tag_values.h"

namespace nightcity::bridges {
namespace {

// The ground below a deck is looked at this often.
constexpr double step_m = 2;
// A longer bridge is a broken map: the longest over which one drives has 55 km (from Hong Kong to
// Zhuhai).
constexpr double max_length_m = 60'000;
// A deck that is nowhere higher than this above its ground has nothing below it, m.
constexpr double min_rise_m = deck_m + 0.5;

bool has_contact_line(const osm::OsmTags& tags) {
  return osm::find_tag(tags, "electrified") == "contact_line";
}

}  // namespace

// Finds decks in the order of their layers, so that a bridge knows how high those are that it
// crosses.
class DeckFinder {
 public:
  DeckFinder(const BridgeMap& map, const place::LonLatToFrame& to_frame,
             const place::HeightAt& height_at)
      : height_at_(height_at),
        map_(place_map(map, to_frame)),
        chains_(join_chains(map_.bridges, map_.ground)) {
    for (std::size_t c = 0; c < chains_.size(); ++c)
      for (const NodeKey& node : chains_[c].nodes) chains_at_[node].push_back(c);
  }

  BridgeDecks find() {
    const CrossedWays crossed(map_.ways);
    crossed_ = &crossed;
    std::vector<std::size_t> order(chains_.size());
    for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
    // Tracks come last: where a street's deck carries them they have none of their own.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(chains_[a].layer, chains_[a].kind) <
             std::pair(chains_[b].layer, chains_[b].kind);
    });
    states_.assign(chains_.size(), State::open);
    // A chain that ends on another waits for it.
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (const std::size_t c : order)
        if (states_[c] == State::open) goes_on |= lift(c);
    }
    for (const std::size_t c : order)
      if (states_[c] == State::open) leave(c, "no abutment at an end");
    return std::move(decks_);
  }

 private:
  enum class State { open, lifted, on_ground };
  enum class EndKind { abutment, on_deck, waits, stairs, air };
  struct End {
    EndKind kind = EndKind::air;
    double height_m = 0;  // of the deck that it ends on
  };

  // Returns whether the chain is decided now.
  bool lift(std::size_t c) {
    const Chain& chain = chains_[c];
    if (chain.is_ring()) return leave(c, "a ring without an abutment");
    const ground_cover::MeasuredLine along(chain.line);
    const double length_m = along.length_m();
    if (!(length_m <= max_length_m)) return leave(c, "longer than 60 km");
    if (chain.kind == Carried::rail && lies_on_street(c)) return true;
    const End ends[2] = {find_end(c, chain.nodes.front()), find_end(c, chain.nodes.back())};
    if (ends[0].kind == EndKind::waits || ends[1].kind == EndKind::waits) return false;
    return lift(c, along, ends);
  }

  bool lift(std::size_t c, const ground_cover::MeasuredLine& along, const End (&ends)[2]) {
    const Chain& chain = chains_[c];
    const auto steps =
        static_cast<std::size_t>(std::max(2.0, std::ceil(along.length_m() / step_m)));
    const auto at = [&](std::size_t i) {
      return along.length_m() * static_cast<double>(i) / static_cast<double>(steps);
    };
    std::vector<std::optional<double>> ground;
    for (std::size_t i = 0; i <= steps; ++i)
      ground.push_back(find_ground(along, at(i), chain.half_m));
    std::size_t first = 0, last = steps;
    while (first < last && !ground[first]) ++first;
    while (last > first && !ground[last]) --last;
    if (last - first < 2) {
      states_[c] = State::on_ground;  // outside the model
      return true;
    }
    DeckCourse course;
    course.length_m = at(last) - at(first);
    course.ground_m.assign(ground.begin() + static_cast<std::ptrdiff_t>(first),
                           ground.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    // An end beyond the model's ground is free.
    for (const bool at_end : {false, true}) {
      if (at_end ? last < steps : first > 0) continue;
      const End& end = ends[at_end];
      if (end.kind == EndKind::air) return leave(c, "no abutment at an end");
      if (end.kind == EndKind::stairs) continue;  // they are as high as the deck
      auto& height_m = at_end ? course.last_m : course.first_m;
      height_m = end.kind == EndKind::on_deck
                     ? end.height_m
                     : height_at_(at_end ? chain.line.back() : chain.line.front());
    }
    add_clearances(chain, at(first), course);
    std::string reason;
    auto profile = find_profile(course, find_kind(chain.kind).rules, reason);
    if (!profile) return leave(c, reason);
    if (course.clearances.empty() && lies_flat(course, *profile))
      return leave(c, "nothing below it");
    build(c, along.cut(at(first), at(last)), at(first), course, std::move(*profile));
    return true;
  }

  // Returns the highest ground below a deck; none where there is none below its middle.
  std::optional<double> find_ground(const ground_cover::MeasuredLine& along, double s,
                                    double half_m) const {
    auto highest = height_at_(along.find_beside(s, 0));
    if (!highest) return highest;
    for (const double left_m : {-half_m, half_m})
      if (const auto side = height_at_(along.find_beside(s, left_m)))
        highest = std::max(highest, side);
    return highest;
  }

  End find_end(std::size_t c, const NodeKey& node) const {
    const Carried kind = chains_[c].kind;
    if (map_.ground.is_abutment(node, kind)) return {EndKind::abutment};
    // A path may end on a street's bridge, and the other way round, and neither on a railway's.
    for (const std::size_t other : chains_at_.at(node)) {
      if (other == c || (kind == Carried::rail) != (chains_[other].kind == Carried::rail)) continue;
      if (states_[other] == State::open) return {EndKind::waits};
      if (states_[other] == State::on_ground) return {EndKind::abutment};
      const auto& nodes = chains_[other].nodes;
      const auto at = std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
      const glm::dvec2& place = chains_[other].line[static_cast<std::size_t>(at)];
      if (const auto height = decks_.height_at(chains_[other].layer, place))
        return {EndKind::on_deck, *height};
    }
    return {kind != Carried::rail && map_.stairs.contains(node) ? EndKind::stairs : EndKind::air};
  }

  void add_clearances(const Chain& chain, double from_m, DeckCourse& course) const {
    for (const Crossing& crossing : crossed_->find(chain)) {
      const PlacedWay& way = map_.ways[crossing.way];
      const double at_m = crossing.at_m - from_m;
      if (way.layer >= chain.layer || at_m < 0 || at_m > course.length_m) continue;
      const auto surface_at = [&](const glm::dvec2& place) {
        const auto on_deck = decks_.find_place(way.way->id, place);
        return on_deck ? std::optional(on_deck->z) : height_at_(place);
      };
      const CarriedKind kind = find_kind(way.kind, has_contact_line(way.way->tags));
      for (Clearance one : find_clearances(chain, way, crossing, kind, surface_at)) {
        one.from_m -= from_m;
        one.to_m -= from_m;
        course.clearances.push_back(one);
      }
    }
  }

  static bool lies_flat(const DeckCourse& course, const DeckProfile& profile) {
    for (std::size_t i = 0; i < course.ground_m.size(); ++i)
      if (!course.ground_m[i] || profile.heights_m[i] - *course.ground_m[i] > min_rise_m)
        return false;
    return true;
  }

  // Returns whether a track runs on the deck of a street, and notes it.
  bool lies_on_street(std::size_t c) {
    const Chain& chain = chains_[c];
    const glm::dvec2& first = chain.line.front();
    for (const std::uint32_t d : decks_.index_.find({first, first})) {
      const Deck& deck = decks_.decks()[d];
      const auto lies_on = [&](const glm::dvec2& place) {
        return deck.project(place).away_m < deck.half_m;
      };
      if (deck.kind == Carried::rail || deck.layer != chain.layer ||
          !std::all_of(chain.line.begin(), chain.line.end(), lies_on))
        continue;
      for (const Chain::Part& part : chain.parts)
        decks_.lifted_.try_emplace(map_.bridges[part.way].way->id,
                                   BridgeDecks::Lifted{d, 0, false, true});
      states_[c] = State::lifted;
      return true;
    }
    return false;
  }

  void build(std::size_t c, std::vector<glm::dvec2> line, double from_m, const DeckCourse& course,
             DeckProfile profile) {
    const Chain& chain = chains_[c];
    Deck deck;
    deck.kind = chain.kind;
    deck.layer = chain.layer;
    deck.half_m = chain.half_m;
    deck.line = std::move(line);
    const ground_cover::MeasuredLine along(deck.line);
    for (std::size_t i = 0; i < deck.line.size(); ++i) deck.at_m.push_back(along.at(i));
    deck.outline = widener_.widen(deck.line, deck.half_m, ground_cover::Widener::Side::both,
                                  ground_cover::Widener::Ends::flat);
    if (deck.outline.empty()) {
      leave(c, "no outline");
      return;
    }
    deck.heights_m = std::move(profile.heights_m);
    if (course.first_m) deck.in_ground_m[0] = find_way_out(course, deck.heights_m, false);
    if (course.last_m) deck.in_ground_m[1] = find_way_out(course, deck.heights_m, true);
    double at_m = -from_m;
    for (const Chain::Part& part : chain.parts) {
      const PlacedWay& way = map_.bridges[part.way];
      const double length_m = ground_cover::MeasuredLine(way.line).length_m();
      decks_.lifted_.try_emplace(
          way.way->id,
          BridgeDecks::Lifted{decks_.decks().size(), part.reversed ? at_m + length_m : at_m,
                              part.reversed, false});
      at_m += length_m;
    }
    BridgeReport::Count& built = decks_.report_.built[name_of(chain.kind)];
    ++built.bridges;
    built.length_m += deck.length_m();
    decks_.report_.low += profile.is_low;
    decks_.add(std::move(deck));
    states_[c] = State::lifted;
  }

  // Returns how far from an end the deck's lower side leaves the ground.
  static double find_way_out(const DeckCourse& course, const std::vector<double>& heights_m,
                             bool from_end) {
    const std::size_t last = heights_m.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      const std::size_t n = from_end ? last - i : i;
      if (!course.ground_m[n] || heights_m[n] - *course.ground_m[n] > deck_m)
        return course.length_m * static_cast<double>(i) / static_cast<double>(last);
    }
    return course.length_m;
  }

  bool leave(std::size_t c, const std::string& reason) {
    BridgeReport::Count& left = decks_.report_.on_ground[reason];
    ++left.bridges;
    left.length_m += ground_cover::MeasuredLine(chains_[c].line).length_m();
    states_[c] = State::on_ground;
    return true;
  }

  const place::HeightAt& height_at_;
  PlacedMap map_;
  std::vector<Chain> chains_;
  std::map<NodeKey, std::vector<std::size_t>> chains_at_;
  std::vector<State> states_;
  const CrossedWays* crossed_ = nullptr;
  ground_cover::Widener widener_;
  BridgeDecks decks_;
};

BridgeDecks find_decks(const BridgeMap& map, const place::LonLatToFrame& to_frame,
                       const place::HeightAt& height_at) {
  return DeckFinder(map, to_frame, height_at).find();
}

}  // namespace nightcity::bridges
