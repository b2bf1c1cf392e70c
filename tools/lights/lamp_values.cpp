#include "tools/lights/lamp_values.h"

#include <algorithm>

#include "formats/colour.h"

namespace nightcity::lights {
namespace {

Known<double> choose_flux(const LampTags& tags, const RoadLighting& defaults,
                          const LampTypeDefaults* type) {
  Known<double> flux{defaults.flux_lm};
  const double of_type = type ? type->flux_lm[static_cast<int>(defaults.tier)] : 0;
  if (of_type > 0) flux = {of_type, ValueSource::tag};
  if (tags.power_w)
    flux = {*tags.power_w * (type ? *type : lamp_type_defaults(LampType::led)).lumen_per_watt,
            ValueSource::tag};
  flux.tagged(tags.flux_lm);
  return flux;
}

Known<double> choose_mounting(const LampTags& tags, const RoadLighting& defaults,
                              const LampTypeDefaults* type) {
  Known<double> mounting{defaults.mounting_m};
  if (tags.mount == LampMount::wall) mounting.value = std::min(mounting.value, wall_mounting_m);
  if (tags.mount == LampMount::bollard) mounting.value = bollard_mounting_m;
  if (type && type->lantern)
    mounting.value = std::min(mounting.value, open_space_defaults().mounting_m);
  mounting.tagged(tags.height_m);
  return mounting;
}

Known<Optic> choose_optic(const LampTags& tags, const RoadLighting& defaults,
                          const LampTypeDefaults* type, double mounting_m) {
  Known<Optic> optic{defaults.optic};
  const bool low = mounting_m < 3 && optic.value == Optic::street;
  if ((type && type->lantern) || tags.mount == LampMount::bollard || low)
    optic.value = Optic::lantern;
  else if (tags.mount == LampMount::bent_mast && optic.value == Optic::lantern)
    optic.value = Optic::street;
  else if (tags.mount == LampMount::suspended)
    optic.value = Optic::central;
  if (tags.mount || tags.type) optic.source = ValueSource::tag;
  return optic;
}

void choose_colour(const LampTags& tags, const RoadLighting& defaults, const LampTypeDefaults* type,
                   LampValues& values) {
  values.cct_k = {type && type->cct_k > 0 ? type->cct_k : defaults.cct_k};
  values.colour = {rec709_from_xy(type && type->xy ? *type->xy : planckian_xy(values.cct_k.value))};
  if (type && (type->xy || type->cct_k > 0)) values.colour.source = ValueSource::tag;
  if (tags.cct_k) {
    values.cct_k.tagged(tags.cct_k);
    values.colour = {rec709_from_xy(planckian_xy(*tags.cct_k)), ValueSource::tag};
  }
  values.colour.tagged(tags.colour);
}

}  // namespace

LampValues choose_values(const LampTags& tags, const RoadLighting& defaults,
                         const LampOptions& options) {
  const LampTypeDefaults* type = tags.type ? &lamp_type_defaults(*tags.type) : nullptr;
  LampValues values{
      choose_mounting(tags, defaults, type), {}, choose_flux(tags, defaults, type), {}, {}};
  values.optic = choose_optic(tags, defaults, type, values.mounting_m.value);
  choose_colour(tags, defaults, type, values);
  const Optic optic = values.optic.value;
  if (optic == Optic::street || optic == Optic::central)
    values.measured = luminaire_for(options, defaults, tags.type.value_or(LampType::led), tags.model);
  if (values.measured) {
    values.optic.source = ValueSource::attribute;
    if (values.measured->take_flux && values.flux_lm.source == ValueSource::rule)
      values.flux_lm = {values.measured->flux_lm, ValueSource::attribute};
  }
  return values;
}

double choose_outreach(const LampTags& tags, const RoadLighting& defaults,
                       std::optional<double> to_centreline_m, std::size_t luminaires) {
  const LampTypeDefaults* type = tags.type ? &lamp_type_defaults(*tags.type) : nullptr;
  double outreach = defaults.outreach_m;
  if (tags.mount == LampMount::straight_mast) outreach = std::min(outreach, 0.3);
  if (tags.mount == LampMount::bent_mast) outreach = std::max(outreach, 1.5);
  if (tags.mount == LampMount::wall) outreach = std::clamp(outreach, 0.6, 1.2);
  if (tags.mount == LampMount::suspended || tags.mount == LampMount::bollard) outreach = 0;
  if (type && type->lantern && tags.mount != LampMount::wall) outreach = 0;
  if (luminaires > 1) return std::max(outreach, 0.4);  // so that they do not overlap
  return to_centreline_m ? std::min(outreach, *to_centreline_m) : outreach;
}

}  // namespace nightcity::lights
