#include "tools/layout/layout_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "formats/median.h"
#include "tools/place/place_grid.h"

namespace nightcity::layout {
namespace {

constexpr double reach_heights = 5;  // EN 13201-3, 8.3: lamps farther away do not count

class Fitter {
 public:
  Fitter(const streets::StreetNetwork& network, const std::vector<StreetPlanned>& plans,
         lights::LampSet& set, std::size_t first_new,
         const std::vector<std::size_t>& street_of_lamp)
      : network_(network),
        plans_(plans),
        set_(set),
        first_new_(first_new),
        street_of_lamp_(street_of_lamp) {
    for (std::uint32_t n = 0; n < set.profiles.size(); ++n) profiles_.push_back(profile_of(set, n));
    for (std::size_t n = 0; n < set.lamps.size(); ++n) {
      const lights::PlacedLamp& lamp = set.lamps[n];
      // Mapped lamps count with their flux, new ones with one lumen that is scaled later.
      luminaires_.push_back(
          {glm::dvec2(lamp.foot) + lamp.outreach, lamp.mounting_height_m, lamp.aim,
           lamp.tilt_degrees, n < first_new ? lamp.flux_lm : 1.0,
           lamp.profile == LIGHT_NO_PROFILE ? nullptr : &profiles_[lamp.profile]});
      grid_.add(luminaires_.back().centre, static_cast<std::uint32_t>(n));
      highest_m_ = std::max(highest_m_, lamp.mounting_height_m);
    }
  }

  void run(const place::HeightAt& height_at, LayoutReport& report) {
    fields_.resize(plans_.size());
    flux_.resize(plans_.size());
    for (std::size_t s = 0; s < plans_.size(); ++s) {
      flux_[s] = plans_[s].design.flux_lm;
      if (plans_[s].lit) lay_field(s, height_at);
    }
    solve();
    for (std::size_t n = first_new_; n < set_.lamps.size(); ++n)
      set_.lamps[n].flux_lm = flux_[street_of_lamp_[n - first_new_]];
    std::vector<std::size_t> lamps(plans_.size());
    for (const std::size_t s : street_of_lamp_) ++lamps[s];
    for (std::size_t s = 0; s < plans_.size(); ++s)
      if (plans_[s].left_to_mapped > lamps[s])
        ++report.notes["stretches left to mapped lamps"];
      else if (fields_[s].length_m > 0 && fields_[s].by_new)
        report_street(s, lamps[s], report);
    sum_up(report);
  }

 private:
  struct Field {
    // For each place along the street. The points themselves would take too much memory.
    std::vector<bool> in_model;
    double length_m = 0;
    double by_mapped_lx = 0;                  // average
    std::map<std::size_t, double> per_lumen;  // average by the street whose lamps give it
    bool by_new = false;
  };

  /// Visits those of `near` that light a point, in their order.
  template <class Visit>
  void each_lamp(const glm::dvec2& p, std::span<const std::uint32_t> near,
                 const Visit& visit) const {
    for (const std::uint32_t n : near)
      if (glm::distance(luminaires_[n].centre, p) <= reach_heights * luminaires_[n].height_m)
        visit(n, illuminance(luminaires_[n], p));
  }

  void lay_field(std::size_t s, const place::HeightAt& height_at) {
    const streets::Street& street = network_.streets[s];
    Field& field = fields_[s];
    const double step = std::min(3.0, plans_[s].design.spacing_m / 10), length = street.length_m();
    const int along = std::max(1, static_cast<int>(std::ceil(length / step)));
    int inside = 0;
    for (int i = 0; i < along; ++i) {
      field.in_model.push_back(
          height_at(street.place((i + 0.5) * length / along).point).has_value());
      inside += field.in_model.back();
    }
    field.length_m = length * inside / along;
    const auto share = 1.0 / std::max(1, inside * points_across(street.road.width_m));
    each_point(s, [&](const glm::dvec2& p, std::span<const std::uint32_t> near) {
      each_lamp(p, near, [&](std::uint32_t n, double lx) {
        if (n < first_new_)
          field.by_mapped_lx += lx * share;
        else
          field.per_lumen[street_of_lamp_[n - first_new_]] += lx * share;
      });
    });
    field.by_new = !field.per_lumen.empty();
  }

  /// Visits the points of a street's field, each with lamps among which are all that light it.
  template <class Visit>
  void each_point(std::size_t s, const Visit& visit) const {
    const streets::Street& street = network_.streets[s];
    const std::vector<bool>& in_model = fields_[s].in_model;
    const int across = points_across(street.road.width_m);
    // The lamps near a row of points across the street are looked for once.
    const double reach_m = reach_heights * highest_m_ + street.road.width_m / 2;
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < in_model.size(); ++i) {
      if (!in_model[i]) continue;
      const streets::Street::Place place =
          street.place((static_cast<double>(i) + 0.5) * street.length_m() /
                       static_cast<double>(in_model.size()));
      near.clear();
      grid_.any_near(place.point, reach_m, [&](const glm::dvec2&, std::uint32_t n) {
        near.push_back(n);
        return false;
      });
      const glm::dvec2 left(-place.along.y, place.along.x);
      for (int j = 0; j < across; ++j)
        visit(place.point + left * (((j + 0.5) / across - 0.5) * street.road.width_m), near);
    }
  }

  double average(const Field& field) const {
    double sum = field.by_mapped_lx;
    for (const auto& [street, lx] : field.per_lumen) sum += lx * flux_[street];
    return sum;
  }

  void solve() {
    // Aim at a tenth above the class: rounding up to a package then keeps it within a quarter.
    constexpr double aim = 1.1;
    constexpr int rounds = 12;
    for (int round = 0; round < rounds; ++round)
      for (std::size_t s = 0; s < plans_.size(); ++s) {
        const Field& field = fields_[s];
        const auto own = field.per_lumen.find(s);
        if (own == field.per_lumen.end() || !(own->second > 0)) continue;
        const double others = average(field) - own->second * flux_[s];
        const double wanted = aim * plans_[s].wanted.average_lx / lights::maintenance_factor;
        const double design = plans_[s].design.flux_lm;
        flux_[s] =
            std::clamp((wanted - others) / own->second, design / max_change, design * max_change);
      }
    for (double& flux : flux_)
      if (flux > 0) flux = luminaire_package(flux);
  }

  void report_street(std::size_t s, std::size_t lamps, LayoutReport& report) const {
    const streets::Street& street = network_.streets[s];
    const StreetPlanned& plan = plans_[s];
    const Field& field = fields_[s];
    StreetReport out;
    out.highway = lighting_of(street).highway;
    out.name = street.name;
    out.wanted = plan.wanted.name;
    std::set<std::int64_t> ways;
    for (const streets::Street::Piece& piece : street.pieces)
      if (ways.insert(piece.way_id).second) out.ways.push_back(piece.way_id);
    out.arrangement = plan.design.arrangement;
    out.length_m = field.length_m;
    out.width_m = street.road.width_m;
    out.spacing_m = plan.design.spacing_m;
    out.flux_lm = flux_[s];
    out.mounting_m = lighting_of(street).mounting_m;
    out.lamps = lamps;
    out.wanted_lx = plan.wanted.average_lx;
    out.field = {average(field), std::numeric_limits<double>::infinity()};
    each_point(s, [&](const glm::dvec2& p, std::span<const std::uint32_t> near) {
      double sum = 0;
      each_lamp(p, near, [&](std::uint32_t n, double lx) {
        sum += n < first_new_ ? lx : lx * flux_[street_of_lamp_[n - first_new_]];
      });
      out.field.min_lx = std::min(out.field.min_lx, sum);
    });
    report.streets.push_back(std::move(out));
  }

  static void sum_up(LayoutReport& report) {
    std::map<std::string, std::vector<double>> least, uniformity;
    std::map<std::string, double> area;
    for (const StreetReport& street : report.streets) {
      RoadClassReport& sum = report.classes[street.highway];
      sum.wanted = street.wanted;
      sum.wanted_lx = street.wanted_lx;
      ++sum.streets;
      sum.lamps += street.lamps;
      sum.length_m += street.length_m;
      const double own_area = street.length_m * street.width_m;
      area[street.highway] += own_area;
      sum.average_lx += street.field.average_lx * own_area;
      const double maintained =
          street.field.average_lx * lights::maintenance_factor / street.wanted_lx;
      if (maintained >= 1 && maintained <= lights::max_excess) sum.in_class += street.length_m;
      if (street.length_m < street.spacing_m) continue;
      least[street.highway].push_back(street.field.min_lx);
      uniformity[street.highway].push_back(street.field.uniformity());
    }
    for (auto& [highway, sum] : report.classes) {
      sum.average_lx /= area[highway];
      sum.in_class /= sum.length_m;
      sum.min_lx = median(least[highway]);
      sum.uniformity = median(uniformity[highway]);
    }
  }

  const streets::StreetNetwork& network_;
  const std::vector<StreetPlanned>& plans_;
  lights::LampSet& set_;
  const std::size_t first_new_;
  const std::vector<std::size_t>& street_of_lamp_;
  std::vector<lights::Photometry> profiles_;
  std::vector<RoadLuminaire> luminaires_;
  place::PlaceGrid grid_{30};
  double highest_m_ = 0;
  std::vector<Field> fields_;
  std::vector<double> flux_;  // by street
};

}  // namespace

void fit_flux(const streets::StreetNetwork& network, const std::vector<StreetPlanned>& plans,
              const place::HeightAt& height_at, lights::LampSet& set, std::size_t first_new,
              const std::vector<std::size_t>& street_of_lamp, LayoutReport& report) {
  Fitter(network, plans, set, first_new, street_of_lamp).run(height_at, report);
}

lights::Photometry profile_of(const lights::LampSet& set, std::uint32_t profile) {
  const LightProfile& from = set.profiles[profile];
  const float* first = set.profile_data.data() + from.data_offset;
  return {from.c_count, from.gamma_count,
          std::vector<double>(first, first + std::size_t{from.c_count} * from.gamma_count)};
}

std::uint32_t add_profile(lights::LampSet& set, const lights::Photometry& photometry) {
  lights::ProfileTable table;
  table.add("", photometry);
  LightProfile profile = table.profiles.front();
  for (std::uint32_t n = 0; n < set.profiles.size(); ++n) {
    const LightProfile& known = set.profiles[n];
    if (known.c_count == profile.c_count && known.gamma_count == profile.gamma_count &&
        std::equal(table.data.begin(), table.data.end(),
                   set.profile_data.begin() + known.data_offset))
      return n;
  }
  profile.data_offset = static_cast<std::uint32_t>(set.profile_data.size());
  set.profiles.push_back(profile);
  set.profile_data.insert(set.profile_data.end(), table.data.begin(), table.data.end());
  return static_cast<std::uint32_t>(set.profiles.size() - 1);
}

}  // namespace nightcity::layout
