#include "tools/layout/layout.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "tools/layout/lamp_appender.h"
#include "tools/layout/layout_design.h"
#include "tools/layout/layout_fit.h"
#include "tools/layout/post_sites.h"
#include "tools/layout/why_unlit.h"
#include "tools/lights/lit_tag.h"

namespace nightcity::layout {
namespace {

constexpr double mapped_reach_spacings = 1.5;
constexpr double mapped_beside_m = 8;  // a mapped lamp this near to the kerb belongs to the street
constexpr double shifts_m[] = {0, 2, -2, 4, -4};
constexpr double median_m = 8;  // a carriageway this near beyond the post is the street's twin
// Between the points at which a street is checked for lying in the model.
constexpr double model_step_m = 10;

const char* name_of(SiteFault fault) {
  constexpr const char* names[] = {"outside the model", "no room before a building",
                                   "in a carriageway"};
  return names[static_cast<int>(fault)];
}

class Layouter {
 public:
  Layouter(const osm::OsmData& osm, const place::LonLatToFrame& to_frame,
           const place::HeightAt& height_at, const place::InsideBuilding& inside,
           const lights::LampOptions& lamps, const LayoutOptions& options, lights::LampSet& set)
      : height_at_(height_at), options_(options), set_(set), lamps_(lamps, set) {
    std::vector<const osm::OsmWay*> lit, unlit;
    for (const osm::OsmWay& way : osm.highways) {
      if (!roads::read_carriageway(way.tags)) continue;
      const lights::LitTags read = lights::read_lit_tags(
          way.tags, "lit", lights::half_at(way.lon_lat.empty() ? 0 : way.lon_lat.front().y));
      const std::string reason = why_unlit(way, read.lit.kind);
      (reason.empty() ? lit : unlit).push_back(&way);
      if (!reason.empty() && in_model(way, to_frame)) ++report_.unlit_ways[reason];
      if (reason.empty() && read.lit.hours) lamps_.set_hours(way.id, *read.lit.hours);
      if (!read.unread.empty() && in_model(way, to_frame))
        for (const std::string& text : read.unread)
          ++report_.notes["tag of a way not understood: " + text];
    }
    network_ = streets::make_street_network(lit, to_frame);
    sites_.emplace(network_, unlit, to_frame, height_at, inside);
    for (std::uint32_t n = 0; n < lamps_.first(); ++n)
      mapped_.add(glm::dvec2(set.lamps[n].foot), n);
  }

  LayoutReport run() {
    plans_.resize(network_.streets.size());
    std::vector<std::size_t> order;
    for (std::size_t s = 0; s < plans_.size(); ++s)
      if (in_model(network_.streets[s])) order.push_back(s);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    for (const std::size_t s : order) plan(s);
    for (const std::size_t s : order)
      for (const std::size_t joint : network_.streets[s].joints) light_joint(joint);
    for (const std::size_t s : order) light_between(s);

    fit_flux(network_, plans_, height_at_, set_, lamps_.first(), lamps_.street_of_lamp(), report_);
    lamps_.count_sources();
    report_.lamps = lamps_.street_of_lamp().size();
    return std::move(report_);
  }

 private:
  // Sorts main roads first, then brighter ones: they get their places before lesser streets do. Of
  // equal ones the network's order decides, which the ids of ways and their order do not change.
  std::tuple<int, double, std::size_t> rank(std::size_t s) const {
    const lights::RoadLighting& road = lighting_of(network_.streets[s]);
    return {static_cast<int>(road.tier), -road.flux_lm, s};
  }

  bool in_model(const osm::OsmWay& way, const place::LonLatToFrame& to_frame) const {
    return std::any_of(way.lon_lat.begin(), way.lon_lat.end(), [&](const glm::dvec2& lon_lat) {
      const glm::dvec2 p = to_frame(lon_lat);
      return std::isfinite(p.x) && std::isfinite(p.y) && height_at_(p);
    });
  }
  bool in_model(const streets::Street& street) const {
    const int parts = std::max(1, static_cast<int>(std::ceil(street.length_m() / model_step_m)));
    for (int part = 0; part <= parts; ++part)
      if (height_at_(street.place(street.length_m() * part / parts).point)) return true;
    return false;
  }

  /// Chooses arrangement, spacing, flux and side of a street.
  void plan(std::size_t s) {
    const streets::Street& street = network_.streets[s];
    const lights::RoadLighting& road = lighting_of(street);
    StreetPlanned& plan = plans_[s];
    const auto own = options_.class_of.find(road.highway);
    const auto wanted =
        lights::lighting_class(own == options_.class_of.end() ? road.target : own->second.c_str());
    if (!wanted) throw std::invalid_argument("no lighting class of EN 13201-2: " + own->second);
    plan.wanted = *wanted;
    plan.design = design(street, arrangement_for(street.road.width_m, road.mounting_m), *wanted);

    // Take the side with fewer obstacles, or the southern one if both are alike. Twin carriageways
    // get their lamps on their outer sides.
    const int parts = parts_of(street, plan.design);
    int faults[2] = {0, 0}, blocked = 0, tried = 0;
    for (int i = 0; i <= parts; ++i) {
      const double along = street.length_m() * i / parts;
      bool by_building[2] = {false, false};
      for (const int side : {-1, 1}) {
        SiteFault fault{};
        const auto site = sites_->beside(s, along, side, fault);
        if (!site && fault == SiteFault::outside_model) continue;
        by_building[side > 0] = !site && fault == SiteFault::building;
        const bool interior = i > 0 && i < parts;
        if (!site ||
            (interior && sites_->near_other_carriageway(s, glm::dvec2(site->foot), median_m)))
          ++faults[side > 0];
      }
      if (height_at_(street.place(along).point)) ++tried;
      if (by_building[0] && by_building[1]) ++blocked;
    }
    plan.side = faults[1] < faults[0] ? 1 : -1;
    if (2 * blocked > tried) plan.design = design(street, Arrangement::central, *wanted);
    plan.lit = true;
  }

  LampDesign design(const streets::Street& street, Arrangement arrangement,
                    const lights::LightingClass& wanted) {
    const lights::RoadLighting& road = lighting_of(street);
    const auto key =
        std::tuple(std::string(road.highway), std::lround(street.road.width_m * 10), arrangement);
    const auto known = designs_.find(key);
    if (known != designs_.end()) return known->second;
    const lights::Photometry profile =
        profile_of(set_, lamps_.profile_for(road, arrangement == Arrangement::central));
    return designs_[key] = design_lamps(road, street.road.width_m, arrangement, wanted, profile);
  }

  static int parts_of(const streets::Street& street, const LampDesign& design) {
    // A street a little longer than a spacing needs no lamp in its middle.
    constexpr double slack = 0.2;
    return std::max(1, static_cast<int>(std::ceil(street.length_m() / design.spacing_m - slack)));
  }

  /// Places one lamp where streets meet or end: on the most important of them, at the corner.
  void light_joint(std::size_t number) {
    if (!joints_done_.insert(number).second) return;
    const streets::Joint& joint = network_.joints[number];
    const streets::Joint::End* best = nullptr;
    double widest_other = 0;
    for (const streets::Joint::End& end : joint.ends) {
      if (!plans_[end.street].lit) continue;
      if (!best || rank(end.street) < rank(best->street)) best = &end;
    }
    if (!best) return;
    for (const streets::Joint::End& end : joint.ends)
      if (&end != best)
        widest_other = std::max(widest_other, network_.streets[end.street].road.width_m);
    const streets::Street& street = network_.streets[best->street];
    const double length = street.length_m();
    const double corner =
        joint.ends.size() < 3
            ? 0
            : std::min(widest_other / 2 + setback_m(lighting_of(street)) + 0.5, length / 3);
    const StreetPlanned& plan = plans_[best->street];
    const double near = 0.6 * plan.design.spacing_m;
    if (lamps_.any_near(joint.point, near)) {
      ++report_.left_out["another lamp at the junction"];
      return;
    }
    light_slot(best->street, best->at_start ? corner : length - corner, plan.side, near);
  }

  void light_between(std::size_t s) {
    const streets::Street& street = network_.streets[s];
    const StreetPlanned& plan = plans_[s];
    const int parts = parts_of(street, plan.design);
    const bool path = lighting_of(street).tier == roads::RoadTier::path;
    const double near = plan.design.spacing_m * (path ? 0.9 : 0.5);
    for (int i = 1; i < parts; ++i) {
      const bool other_side = plan.design.arrangement == Arrangement::staggered && i % 2 != 0;
      light_slot(s, street.length_m() * i / parts, other_side ? -plan.side : plan.side, near);
    }
  }

  /// Places the lamp or pair of lamps of a street at `along`.
  void light_slot(std::size_t s, double along, int side, double near) {
    const streets::Street& street = network_.streets[s];
    const LampDesign& design = plans_[s].design;
    const streets::Street::Place centre = street.place(along);
    if (!height_at_(centre.point)) return;  // the street continues beyond the model
    if (mapped_near(street, centre, design.spacing_m)) {
      ++report_.left_out["mapped lamps near"];
      ++plans_[s].left_to_mapped;
      return;
    }
    if (lamps_.lit_by_another(s, centre.point, near)) {
      ++report_.left_out["another street's lamp near"];
      return;
    }
    SiteFault fault = SiteFault::building;
    if (design.arrangement == Arrangement::central) {
      const auto site = sites_->above(s, along, fault);
      return site ? put(s, *site) : leave_out(fault);
    }
    const bool pair = design.arrangement == Arrangement::opposite;
    bool any = false;
    for (const int wanted_side : {side, -side}) {
      if (any && !pair) break;
      if (const auto site = search(s, along, wanted_side, fault)) {
        put(s, *site);
        any = true;
      }
    }
    if (any) return;
    if (fault == SiteFault::building)
      if (const auto site = sites_->above(s, along, fault)) {
        ++report_.notes["hung over the street: no room beside it"];
        return put(s, *site);
      }
    leave_out(fault);
  }

  void put(std::size_t s, const PostSite& site) {
    if (site.moved) ++report_.notes["moved away from a building"];
    const LampDesign& design = plans_[s].design;
    ++report_.arrangements[layout::name_of(site.side == 0 ? Arrangement::central
                                                          : design.arrangement)];
    lamps_.append(s, network_.streets[s], design, site);
  }

  void leave_out(SiteFault fault) { ++report_.left_out[name_of(fault)]; }

  std::optional<PostSite> search(std::size_t s, double along, int side, SiteFault& fault) const {
    const double length = network_.streets[s].length_m();
    for (const double shift : shifts_m) {
      const double at = along + shift;
      if (at < 0 || at > length) continue;
      if (const auto site = sites_->beside(s, at, side, fault)) return site;
    }
    return std::nullopt;
  }

  bool mapped_near(const streets::Street& street, const streets::Street::Place& centre,
                   double spacing_m) const {
    const double beside = street.road.width_m / 2 + mapped_beside_m;
    return mapped_.any_near(
        centre.point, mapped_reach_spacings * spacing_m, [&](const glm::dvec2& p, std::uint32_t) {
          const glm::dvec2 d = p - centre.point;
          return std::abs(d.x * centre.along.y - d.y * centre.along.x) <= beside;
        });
  }

  const place::HeightAt& height_at_;
  const LayoutOptions& options_;
  lights::LampSet& set_;
  LampAppender lamps_;
  streets::StreetNetwork network_;
  std::optional<PostSites> sites_;
  std::vector<StreetPlanned> plans_;
  std::map<std::tuple<std::string, long, Arrangement>, LampDesign> designs_;
  place::PlaceGrid mapped_{30};
  std::set<std::size_t> joints_done_;
  LayoutReport report_;
};

}  // namespace

LayoutReport lay_out_lamps(const osm::OsmData& osm, const place::LonLatToFrame& to_frame,
                           const place::HeightAt& height_at, const place::InsideBuilding& inside,
                           const lights::LampOptions& lamps, const LayoutOptions& options,
                           lights::LampSet& set) {
  if (options.mode == LayoutOptions::Mode::never) return {};
  return Layouter(osm, to_frame, height_at, inside, lamps, options, set).run();
}

}  // namespace nightcity::layout
