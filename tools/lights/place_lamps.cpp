#include "tools/lights/place_lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <unordered_set>

#include "tools/lights/lamp_aims.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lamp_tags.h"
#include "tools/lights/lamp_values.h"
#include "tools/lights/optics.h"
#include "tools/lights/photometry.h"
#include "tools/lights/road_index.h"
#include "tools/lights/taken_places.h"
#include "tools/line.h"
#include "tools/random.h"

namespace nightcity::lights {
namespace {

constexpr double step_out_m = 0.25, farthest_out_m = 12;

/// Neighbouring OSM ids give unrelated light ids.
std::uint32_t hash_id(std::int64_t node, int luminaire, int attempt) {
  const std::uint64_t key =
      static_cast<std::uint64_t>(node) * 64 + static_cast<std::uint64_t>(luminaire);
  return static_cast<std::uint32_t>(
      mix(key + static_cast<std::uint64_t>(attempt) * splitmix_increment) >> 32);
}

class Placer {
 public:
  Placer(const osm::OsmData& osm, const place::LonLatToFrame& to_frame,
         const place::HeightAt& height_at, const place::InsideBuilding& inside,
         const LampOptions& options)
      : osm_(osm),
        options_(options),
        to_frame_(to_frame),
        height_at_(height_at),
        inside_(inside),
        roads_(osm.highways, to_frame) {}

  LampSet place() {
    std::vector<Post> posts;
    for (const osm::OsmLampNode& node : osm_.lamps) find_post(node, posts);
    leave_out_duplicates(posts);
    for (const Post& post : posts)
      if (!post.is_duplicate) place(post);
    set_.profiles = std::move(profiles_.profiles);
    set_.profile_data = std::move(profiles_.data);
    return std::move(set_);
  }

 private:
  void leave_out(std::string_view reason) { ++set_.left_out[std::string(reason)]; }

  struct Post {
    const osm::OsmLampNode* node;
    LampTags tags;
    glm::dvec2 at;
    bool is_duplicate = false;
  };

  void find_post(const osm::OsmLampNode& node, std::vector<Post>& posts) {
    LampTags tags = read_lamp_tags(node.tags, half_at(node.lon_lat.y));
    for (const auto& [text, count] : tags.unread)
      set_.notes[(node.is_inventory ? "inventory value not understood: " : "tag not understood: ") +
                 text] += count;
    if (tags.unlit) return leave_out(tags.outage);
    const glm::dvec2 at = to_frame_(node.lon_lat);
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) return leave_out("outside the projection");
    if (!height_at_(at)) return leave_out("outside the model");
    posts.push_back({&node, std::move(tags), at});
  }

  /// Leaves one post in each place: an inventory's, else the one of which the map says more. Their
  /// ids and their order do not matter.
  void leave_out_duplicates(std::vector<Post>& posts) {
    std::vector<Post*> order;
    for (Post& post : posts) order.push_back(&post);
    std::stable_sort(order.begin(), order.end(), [](const Post* a, const Post* b) {
      const auto key = [](const osm::OsmLampNode& node) {
        return std::tuple(!node.is_inventory, -static_cast<std::ptrdiff_t>(node.tags.size()));
      };
      if (key(*a->node) != key(*b->node)) return key(*a->node) < key(*b->node);
      if (a->at != b->at) return comes_before(a->at, b->at);
      return a->node->tags < b->node->tags;
    });
    for (Post* post : order)
      if (!taken_.take(post->at)) {
        post->is_duplicate = true;
        leave_out("duplicate");
      }
  }

  void place(const Post& post) {
    glm::dvec2 at = post.at;
    const auto road = roads_.nearest(at);
    const bool moved = step_out(at, road);
    const auto height = height_at_(at);
    if (!height) return leave_out("outside the model");
    const double foot = options_.heights_from_tags ? post.tags.ele_m.value_or(*height) : *height;
    add_post(*post.node, post.tags, {at.x, at.y, foot},
             moved ? ValueSource::rule : ValueSource::tag, road);
  }

  /// Moves a post that stands inside a building out of it, towards its road. Returns whether it
  /// moved.
  bool step_out(glm::dvec2& at, const std::optional<RoadIndex::Nearest>& road) {
    if (!inside_ || !inside_(at)) return false;
    if (road && road->distance_m > step_out_m) {
      const glm::dvec2 towards = (road->point - at) / road->distance_m;
      for (double s = step_out_m; s <= std::min(farthest_out_m, road->distance_m); s += step_out_m)
        if (!inside_(at + towards * s)) {
          at += towards * s;
          ++set_.notes["moved out of a building"];
          return true;
        }
    }
    ++set_.notes["left inside a building"];
    return false;
  }

  const RoadLighting& defaults_for(const LampTags& tags,
                                   const std::optional<RoadIndex::Nearest>& road) const {
    if (tags.mast) return lighting_mast_defaults();
    return road ? *road->road->lighting : open_space_defaults();
  }

  /// Adds the luminaires of one post.
  void add_post(const osm::OsmLampNode& node, const LampTags& tags, const glm::dvec3& foot,
                ValueSource position, const std::optional<RoadIndex::Nearest>& road) {
    const RoadLighting& defaults = defaults_for(tags, road);
    const LampValues values = choose_values(tags, defaults, options_);
    PlacedLamp lamp = make_lamp(tags, values);
    if (node.is_inventory) tell_inventory(lamp.provenance);
    lamp.foot = foot;
    lamp.provenance.source_id = static_cast<std::uint64_t>(node.id);
    lamp.provenance.position =
        node.is_inventory && position == ValueSource::tag ? ValueSource::inventory : position;
    lamp.highway = defaults.highway;
    if (road) {
      lamp.way_id = road->road->way_id;
      lamp.along_m = road->along_m;
    }
    const std::vector<glm::dvec2> aims = find_aims(node.lon_lat, tags, foot, road, to_frame_);
    if (aims.size() > 2 && lamp.provenance.flux != ValueSource::inventory)
      lamp.flux_lm *= 2.0 / static_cast<double>(aims.size());  // clusters share two lamps' light
    std::optional<double> to_centreline_m;
    if (road) to_centreline_m = road->distance_m;
    for (std::size_t n = 0; n < aims.size(); ++n) {
      lamp.aim = aims[n];
      lamp.outreach =
          clear_of_walls(glm::dvec2(foot),
                         lamp.aim * choose_outreach(tags, defaults, to_centreline_m, aims.size()));
      lamp.id = unused_id(node.id, static_cast<int>(n));
      set_.lamps.push_back(lamp);
      count_sources(lamp.provenance, tags, road);
    }
  }

  static void tell_inventory(LightProvenance& from) {
    for (ValueSource* source :
         {&from.height, &from.flux, &from.colour, &from.profile, &from.schedule})
      if (*source == ValueSource::tag) *source = ValueSource::inventory;
  }

  PlacedLamp make_lamp(const LampTags& tags, const LampValues& values) {
    PlacedLamp lamp;
    lamp.mounting_height_m = values.mounting_m.value;
    lamp.hung = tags.mount == LampMount::suspended;
    lamp.flux_lm = values.flux_lm.value;
    lamp.cct_k = values.cct_k.value;
    lamp.colour = values.colour.value;
    const Optic optic = values.optic.value;
    lamp.radius_m = optic == Optic::lantern ? lantern_radius_m : luminous_radius_m;
    lamp.profile = values.measured
                       ? profiles_.add(values.measured->name, values.measured->photometry)
                       : profile_of(optic);
    if (optic == Optic::floodlight) lamp.tilt_degrees = 55;
    if (tags.tilt_degrees) lamp.tilt_degrees = *tags.tilt_degrees;
    lamp.hours = tags.hours;
    lamp.provenance.height = values.mounting_m.source;
    lamp.provenance.flux = values.flux_lm.source;
    lamp.provenance.colour = values.colour.source;
    lamp.provenance.profile = values.optic.source;
    lamp.provenance.schedule = tags.hours ? ValueSource::tag : ValueSource::rule;
    lamp.provenance.family = static_cast<std::uint8_t>(LightFamily::lamp);
    return lamp;
  }

  std::uint32_t profile_of(Optic optic) {
    std::optional<std::uint32_t>& known = optics_[static_cast<std::size_t>(optic)];
    if (!known) known = profiles_.add(nightcity::lights::name_of(optic), make_optic(optic));
    return *known;
  }

  /// Returns the outreach, shortened if it would bring the luminaire into a building outside which
  /// its post stands.
  glm::dvec2 clear_of_walls(const glm::dvec2& foot, const glm::dvec2& outreach) {
    if (!inside_ || !inside_(foot + outreach) || inside_(foot)) return outreach;
    constexpr int steps = 8;
    ++set_.notes["luminaire drawn back from a building"];
    for (int n = steps - 1; n > 0; --n)
      if (const glm::dvec2 shorter = outreach * (static_cast<double>(n) / steps);
          !inside_(foot + shorter))
        return shorter;
    return glm::dvec2(0);
  }

  std::uint32_t unused_id(std::int64_t node, int luminaire) {
    for (int attempt = 0;; ++attempt) {
      const std::uint32_t id = hash_id(node, luminaire, attempt);
      if (id != 0xFFFFFFFFu && ids_.insert(id).second) return id;
    }
  }

  void count_sources(const LightProvenance& from, const LampTags& tags,
                     const std::optional<RoadIndex::Nearest>& road) {
    const auto count = [&](const char* value, ValueSource source) {
      ++set_.sources[value][name_of(source)];
    };
    count("position", from.position);
    count("height", from.height);
    count("flux", from.flux);
    count("colour", from.colour);
    count("profile", from.profile);
    ++set_.sources["aim"][!tags.directions_degrees.empty() ? "tag"
                          : road                           ? "road beside"
                                                           : "no road near"];
    ++set_.sources["road class"][tags.mast ? "lighting mast"
                                 : road    ? road->road->lighting->highway
                                           : "open space"];
  }

  const osm::OsmData& osm_;
  const LampOptions& options_;
  const place::LonLatToFrame& to_frame_;
  const place::HeightAt& height_at_;
  const place::InsideBuilding& inside_;
  RoadIndex roads_;
  TakenPlaces taken_;
  ProfileTable profiles_;
  std::array<std::optional<std::uint32_t>, 4> optics_;
  std::unordered_set<std::uint32_t> ids_;
  LampSet set_;
};

}  // namespace

const LuminaireChoice* luminaire_for(const LampOptions& options, const RoadLighting& road,
                                     LampType type, const std::string& model) {
  const auto serves = [](const auto& list, const auto& value) {
    return list.empty() || std::find(list.begin(), list.end(), value) != list.end();
  };
  for (const LuminaireChoice& choice : options.luminaires)
    if (serves(choice.highways, road.highway) && serves(choice.types, type) &&
        serves(choice.models, model))
      return &choice;
  return nullptr;
}

LampSet place_lamps(const osm::OsmData& osm, const place::LonLatToFrame& to_frame,
                    const place::HeightAt& height_at, const place::InsideBuilding& inside,
                    const LampOptions& options) {
  return Placer(osm, to_frame, height_at, inside, options).place();
}

}  // namespace nightcity::lights
