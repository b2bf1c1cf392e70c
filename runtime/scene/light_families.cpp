#include "runtime/scene/light_families.h"

#include <sstream>

#include "formats/error.h"

namespace nightcity::scene {
namespace {

LightFamily family_at(std::size_t index) {
  return static_cast<LightFamily>(index);
}

std::string list_names() {
  std::string names;
  for (std::size_t i = 0; i < light_family_count; ++i)
    names += (i > 0 ? ", " : "") + std::string(name_of(family_at(i)));
  return names;
}

LightFamilies find_by_name(const std::string& word) {
  if (word == "all") return all_families;
  if (word == "none") return 0;
  for (std::size_t i = 0; i < light_family_count; ++i)
    if (word == name_of(family_at(i))) return to_set(family_at(i));
  throw UsageError("--lights",
                   "'" + word + "' is no kind of light: all, none, or a list of " + list_names());
}

}  // namespace

bool has_family(LightFamilies set, LightFamily family) {
  const bool known = static_cast<std::size_t>(family) < light_family_count;
  return (set & to_set(known ? family : LightFamily::other)) != 0;
}

LightFamilies parse_families(const std::string& text) {
  LightFamilies set = 0;
  std::istringstream words(text);
  std::string word;
  bool any = false;
  for (; std::getline(words, word, ','); any = true) set |= find_by_name(word);
  if (!any) find_by_name("");
  return set;
}

std::string text_of(LightFamilies set) {
  if ((set & all_families) == all_families) return "all";
  std::string text;
  for (std::size_t i = 0; i < light_family_count; ++i)
    if (has_family(set, family_at(i)))
      text += (text.empty() ? "" : ",") + std::string(name_of(family_at(i)));
  return text.empty() ? "none" : text;
}

std::vector<Light> darkened(std::span<const Light> vehicle_lights, LightFamilies on) {
  std::vector<Light> lights(vehicle_lights.begin(), vehicle_lights.end());
  for (Light& light : lights)
    if (!has_family(on, static_cast<LightFamily>(light.id))) light.flux_lm = 0;
  return lights;
}

}  // namespace nightcity::scene
