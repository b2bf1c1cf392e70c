#include "runtime/render/model_parts.h"

#include <algorithm>

#include "formats/error.h"
#include "runtime/render/parse.h"

namespace nightcity::render {
namespace {

using scene::Part;

std::string list_names() {
  std::string names;
  for (const ModelPart& part : list_model_parts())
    names += (names.empty() ? "" : ", ") + std::string(part.name);
  return names;
}

}  // namespace

const std::vector<ModelPart>& list_model_parts() {
  static const std::vector<ModelPart> parts{
      {"windows", "no lit windows: neither their light nor their panes", Part::windows},
      {"traffic", "no vehicles", Part::traffic},
      {"profiles",
       "lamps and headlamps without luminaire profiles: the same flux, evenly all round",
       Part::profiles, true},
      {"aim", "lamps that look straight down, all turned alike", Part::aim, true},
      {"lamp-size", "lamps without size: points, with hard shadows", Part::lamp_sizes, true},
      {"schedules", "every lamp and window lit all night", Part::schedules},
      {"lamp-bodies", "no posts, arms and housings of lamps", Part::lamp_bodies},
      {"trees", "no trees", Part::trees},
      {"vehicle-shadows", "vehicles that cast no shadow", Part::vehicle_shadows},
      {"colours", "one grey for all surfaces, the mean of their reflectances", Part::colours},
      {"textures", "no pictures on surfaces: the mean of each", Part::textures},
      {"water", "water without mirror images", Part::water},
      {.name = "wet",
       .help = "dry streets",
       .is_set = [](const RenderSettings& s) { return s.environment.wetness > 0; },
       .turn_off = [](RenderSettings& s) { s.environment.wetness = 0; }},
      {.name = "air",
       .help = "clear air",
       .is_set = [](const RenderSettings& s) { return s.air.visibility_km > 0; },
       .turn_off = [](RenderSettings& s) { s.air.visibility_km = 0; }},
      {.name = "sky",
       .help = "a black sky",
       .is_set = [](const RenderSettings& s) { return s.environment.sky_cd_m2 != glm::vec3(0); },
       .turn_off =
           [](RenderSettings& s) {
             s.environment.sky_cd_m2 = glm::vec3(0);
             s.environment.glow = SkyGlow::none;
           }},
      {.name = "moon",
       .help = "no moon",
       .is_set = [](const RenderSettings& s) { return s.environment.moon_lux != glm::vec3(0); },
       .turn_off = [](RenderSettings& s) { s.environment.moon_lux = glm::vec3(0); }},
      {.name = "bounces",
       .help = "direct light alone",
       .is_set = [](const RenderSettings& s) { return s.indirect.bounces > 0; },
       .turn_off = [](RenderSettings& s) { s.indirect.bounces = 0; }},
  };
  return parts;
}

std::string describe_model_parts() {
  std::string text;
  for (const ModelPart& part : list_model_parts())
    text += std::string("\n  ") + part.name + ": " + part.help;
  return text;
}

bool is_present(const ModelPart& part, const scene::RenderScene& scene,
                const RenderSettings& settings) {
  return part.of_scene ? scene.parts[static_cast<std::size_t>(*part.of_scene)] > 0
                       : part.is_set(settings);
}

std::string name_parts(const scene::PartSet& parts) {
  LeftOut named;
  for (const ModelPart& part : list_model_parts())
    if (part.of_scene && parts[static_cast<std::size_t>(*part.of_scene)]) named.add(part);
  return named.text();
}

LeftOut::LeftOut(const std::string& names) {
  if (names.empty() || names == "none") return;
  for (const std::string& name : split_list("--leave-out", names)) {
    const auto& all = list_model_parts();
    const auto part = std::find_if(all.begin(), all.end(),
                                   [&](const ModelPart& each) { return name == each.name; });
    if (part == all.end())
      throw UsageError("--leave-out",
                       "there is no part '" + name + "' (there are " + list_names() + ")");
    add(*part);
  }
}

void LeftOut::add(const ModelPart& part) {
  if (holds(part)) return;
  parts_.push_back(&part);
  std::sort(parts_.begin(), parts_.end());  // they lie in one table
}

void LeftOut::remove(const ModelPart& part) {
  std::erase(parts_, &part);
}

bool LeftOut::holds(const ModelPart& part) const {
  return std::find(parts_.begin(), parts_.end(), &part) != parts_.end();
}

std::string LeftOut::text() const {
  std::string names;
  for (const ModelPart* part : parts_)
    names += (names.empty() ? "" : ",") + std::string(part->name);
  return names;
}

scene::PartSet LeftOut::of_scene() const {
  scene::PartSet set;
  for (const ModelPart* part : parts_)
    if (part->of_scene) set.set(static_cast<std::size_t>(*part->of_scene));
  return set;
}

void LeftOut::apply(RenderSettings& settings) const {
  for (const ModelPart* part : parts_)
    if (part->turn_off) part->turn_off(settings);
}

}  // namespace nightcity::render
