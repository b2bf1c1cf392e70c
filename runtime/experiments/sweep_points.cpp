#include "runtime/experiments/sweep_points.h"

#include <set>

#include "runtime/render/parse.h"

namespace nightcity::experiments {
namespace {

// Settings that make no difference get the value "-", so that equal settings are measured once.
SweepPoint without_unused(SweepPoint point) {
  const render::RenderSettings settings = to_settings(point);
  for (const render::Setting& setting : list_swept_settings())
    // A string made of one character: assigning "-" draws a false warning from g++ 12.
    if (!setting.applies(settings)) point[setting.name] = std::string(1, '-');
  return point;
}

}  // namespace

std::vector<render::Setting> list_swept_settings() {
  std::vector<render::Setting> swept;
  for (const render::Setting& setting : render::list_settings())
    if (setting.is_swept) swept.push_back(setting);
  return swept;
}

std::vector<SweepPoint> list_combinations(const std::map<std::string, std::string>& chosen) {
  std::vector<SweepPoint> all{{}};
  for (const render::Setting& setting : list_swept_settings()) {
    const auto given = chosen.find(setting.name);
    const std::string list = given == chosen.end() || given->second.empty()
                                 ? render::default_list(setting)
                                 : given->second;
    std::vector<SweepPoint> longer;
    for (const SweepPoint& so_far : all)
      for (const std::string& word : render::split_list(render::option_of(setting), list)) {
        render::RenderSettings ignored;
        render::set_from_text(setting, ignored, word);
        longer.push_back(so_far);
        longer.back()[setting.name] = word;
      }
    all = std::move(longer);
  }
  std::set<SweepPoint> seen;
  std::vector<SweepPoint> unique;
  for (SweepPoint& point : all)
    if (SweepPoint once = without_unused(std::move(point)); seen.insert(once).second)
      unique.push_back(std::move(once));
  return unique;
}

render::RenderSettings to_settings(const SweepPoint& point, const render::RenderSettings& base) {
  render::RenderSettings settings = base;
  settings.sampling.jitter = false;  // measures the error of light, not of edges
  for (const render::Setting& setting : list_swept_settings()) {
    const auto given = point.find(setting.name);
    if (given != point.end() && given->second != "-")
      render::set_from_text(setting, settings, given->second);
  }
  return settings;
}

}  // namespace nightcity::experiments
