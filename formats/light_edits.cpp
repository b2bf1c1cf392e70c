#include "formats/light_edits.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/json_parse.h"
#include "formats/small_file.h"

namespace nightcity {
namespace {

using nlohmann::json;

constexpr int version = 1;
constexpr std::size_t max_bytes = std::size_t{1} << 30;

std::string text_of(std::uint32_t id) {
  char text[9];
  std::snprintf(text, sizeof text, "%08x", id);
  return text;
}

std::uint32_t read_id(const json& light, const std::string& place) {
  const auto found = light.find("id");
  std::uint32_t id = 0;
  if (found != light.end() && found->is_string()) {
    const std::string& text = found->get_ref<const std::string&>();
    const char* end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, id, 16);
    if (!text.empty() && stop == end && fault == std::errc()) return id;
  }
  throw Error(place, "\"id\" must be a light's identity, up to eight hexadecimal digits");
}

glm::vec3 read_aim(const json& value, const std::string& place) {
  glm::dvec3 aim(0);
  const bool good = value.is_array() && value.size() == 3 && value[0].is_number() &&
                    value[1].is_number() && value[2].is_number();
  if (good) aim = {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
  const double length = glm::length(aim);
  if (!(length > 1e-6 && length < 1e6))
    throw Error(place, "\"aim\" must be a direction: [east, north, up]");
  return glm::vec3(aim / length);
}

LightEdit read_edit(const json& light, const std::string& place) {
  LightEdit edit;
  for (const auto& [key, value] : light.items()) {
    if (key == "id" || key == "comment") continue;
    if (key == "off" && value.is_boolean())
      edit.is_off = value.get<bool>();
    else if (key == "flux_lm" && value.is_number() && value.get<double>() > 0 &&
             value.get<double>() <= 1e12)
      edit.flux_lm = value.get<double>();
    else if (key == "aim")
      edit.aim = read_aim(value, place);
    else
      throw Error(place, "\"" + key +
                             "\" is not understood: off is true or false, flux_lm a number of "
                             "lumens above 0, aim a direction [east, north, up]");
  }
  return edit;
}

}  // namespace

LightEdits read_light_edits(const std::filesystem::path& file) {
  const json document = try_parse_json(read_small_file(file, max_bytes));
  if (!document.is_object() || !document.contains("lights") || !document["lights"].is_array())
    throw Error(file.string(), "holds no edits of lights: {\"version\": 1, \"lights\": [...]}");
  if (document.value("version", json(version)) != json(version))
    throw Error(file.string(), "is of another version of this format");
  LightEdits edits;
  for (std::size_t i = 0; i < document["lights"].size(); ++i) {
    const json& light = document["lights"][i];
    const std::string place = file.string() + ": lights[" + std::to_string(i) + "]";
    if (!light.is_object()) throw Error(place, "must be an object");
    if (!edits.emplace(read_id(light, place), read_edit(light, place)).second)
      throw Error(place, "edits a light that an earlier one edits, too");
  }
  return edits;
}

void write_light_edits(const std::filesystem::path& file, const LightEdits& edits) {
  json lights = json::array();
  for (const auto& [id, edit] : edits) {
    json light{{"id", text_of(id)}};
    if (edit.is_off) light["off"] = true;
    if (edit.flux_lm) light["flux_lm"] = *edit.flux_lm;
    if (edit.aim) light["aim"] = {edit.aim->x, edit.aim->y, edit.aim->z};
    lights.push_back(std::move(light));
  }
  AtomicFile out(file);
  out.write(json{{"version", version}, {"lights", lights}}.dump(2) + "\n");
  out.commit();
}

void apply_edit(const LightEdit& edit, Light& light) {
  if (edit.flux_lm) light.flux_lm = static_cast<float>(*edit.flux_lm);
  if (edit.is_off) light.flux_lm = 0;
  if (!edit.aim) return;
  light.axis = glm::normalize(glm::vec3(edit.aim->x, edit.aim->z, -edit.aim->y));
  glm::vec3 tangent = light.tangent - light.axis * glm::dot(light.tangent, light.axis);
  if (glm::length(tangent) < 1e-3f) {  // it lay along the new axis
    const glm::vec3 other = std::abs(light.axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    tangent = glm::cross(other, light.axis);
  }
  light.tangent = glm::normalize(tangent);
}

std::size_t apply_edits(const LightEdits& edits, std::span<Light> lights) {
  std::set<std::uint32_t> found;
  if (edits.empty()) return 0;
  for (Light& light : lights) {
    const auto edit = edits.find(light.id);
    if (edit == edits.end()) continue;
    apply_edit(edit->second, light);
    found.insert(light.id);
  }
  return edits.size() - found.size();
}

}  // namespace nightcity
