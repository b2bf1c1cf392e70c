#include <array>
#include <map>

#include "formats/light_file.h"
#include "tools/nightbake/inspect.h"

namespace nightcity {
namespace {

const char* name_of(LightFamily family) {
  switch (family) {
    case LightFamily::lamp:
      return "lamp";
    case LightFamily::window:
      return "window";
    case LightFamily::headlamp:
      return "headlamp";
    case LightFamily::tail_lamp:
      return "tail_lamp";
    case LightFamily::other:
      break;
  }
  return "other";
}

const char* name_of(ValueSource source) {
  switch (source) {
    case ValueSource::tag:
      return "tag";
    case ValueSource::attribute:
      return "attribute";
    case ValueSource::rule:
      return "rule";
    case ValueSource::standard:
      return "standard";
    case ValueSource::unknown:
      break;
  }
  return "unknown";
}

}  // namespace

Inspection inspect_lights(const std::filesystem::path& file) {
  const LightFile lights = LightFile::open(file);
  lights.verify();
  Inspection result = empty_inspection("lights");
  const Georeference& geo = lights.georeference();
  std::map<std::string, std::size_t> families, kinds;
  std::map<std::string, double> flux;
  std::map<std::string, std::map<std::string, std::size_t>> sources;
  Bounds bounds;
  std::size_t scheduled = 0;
  for (std::size_t i = 0; i < lights.lights().size(); ++i) {
    const Light& light = lights.lights()[i];
    const LightProvenance& origin = lights.provenance()[i];
    const std::string family = name_of(static_cast<LightFamily>(origin.family));
    ++families[family];
    flux[family] += double{light.flux_lm};
    ++kinds[(light.kind_profile & 0xFFu) == LIGHT_SPHERE ? "sphere" : "rectangle"];
    if (light.schedule != LIGHT_ALWAYS_ON) ++scheduled;
    bounds.add(geo.from_model(glm::dvec3(light.position)));
    ++sources["position"][name_of(origin.position)];
    ++sources["height"][name_of(origin.height)];
    ++sources["flux"][name_of(origin.flux)];
    ++sources["colour"][name_of(origin.colour)];
    ++sources["profile"][name_of(origin.profile)];
  }
  for (const auto& [family, count] : families) result["lights"][family] = count;
  if (!geo.crs.empty()) result["crs"] = geo.crs;
  result["bbox"] = bounds.json(3);
  result["origin"] = {geo.origin.x, geo.origin.y, geo.origin.z};
  result["kinds"] = kinds;
  result["flux_lm"] = flux;
  result["profiles"] = lights.profiles().size();
  result["scheduled"] = scheduled;
  result["value_sources"] = sources;
  result["sources"] = geo.sources;
  result["licences"] = geo.licences;
  return result;
}

}  // namespace nightcity
