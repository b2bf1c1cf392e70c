#include "tools/obj/materials.h"

#include <algorithm>
#include <string_view>
#include <system_error>

#include "formats/error.h"
#include "tools/city/attributes.h"
#include "tools/city/byte_source.h"
#include "tools/obj/text_lines.h"

namespace nightcity::obj {
namespace {

// "Kd r g b"; one number stands for all three. "Kd spectral" and "Kd xyz" are not read.
std::optional<glm::vec3> read_colour(std::string_view text, const TextLines& lines) {
  double r = 0, g = 0, b = 0;
  std::string_view first = text;
  if (const std::string_view word = take_word(first); word == "spectral" || word == "xyz")
    return {};
  if (!take_number(text, r))
    throw Error(lines.name(), lines.number(), "Kd is no colour: three numbers are wanted");
  g = b = r;
  if (take_number(text, g) && !take_number(text, b))
    throw Error(lines.name(), lines.number(), "Kd has two numbers: three are wanted");
  const auto clamp = [](double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); };
  return glm::vec3(clamp(r), clamp(g), clamp(b));
}

}  // namespace

void read_materials(const std::filesystem::path& file, std::map<std::string, Material>& materials) {
  const auto documents = city::list_documents(file, {});
  TextLines lines(documents.front().open(), file.string());
  Material* current = nullptr;
  for (std::string_view line; lines.next(line);) {
    const std::string_view key = take_word(line);
    if (key == "newmtl") {
      current = &materials[std::string(city::trim(line))];
      *current = {};
    } else if (current && key == "Kd") {
      current->colour = read_colour(line, lines);
    } else if (current && (key == "map_Kd" || key == "map_kd")) {
      current->has_texture = true;
    }
  }
}

std::filesystem::path find_library(const std::filesystem::path& obj, const std::string& name) {
  const std::filesystem::path written(name);
  if (name.empty() || written.is_absolute()) return {};
  for (const auto& part : written)
    if (part == "..") return {};
  const std::filesystem::path file = obj.parent_path() / written;
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) ? file : std::filesystem::path();
}

}  // namespace nightcity::obj
