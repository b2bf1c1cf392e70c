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

// Takes up to `most` numbers that an option of a texture has.
int take_numbers(std::string_view& text, int most, double* values) {
  int count = 0;
  while (count < most && take_number(text, values[count])) ++count;
  return count;
}

// "map_Kd -s 2 2 1 -clamp on brick wall.png": options, and a name that may hold blanks.
Texture read_texture(std::string_view text, const std::filesystem::path& folder_of_file) {
  Texture texture;
  for (;;) {
    std::string_view rest = text;
    const std::string_view option = take_word(rest);
    double v[3] = {};
    if (option == "-s" || option == "-o" || option == "-t") {
      glm::dvec2& target = option == "-s" ? texture.scale : texture.offset;
      const int count = take_numbers(rest, 3, v);
      if (option != "-t" && count > 0) target = {v[0], count > 1 ? v[1] : target.y};
    } else if (option == "-mm") {
      take_numbers(rest, 2, v);
    } else if (option == "-bm" || option == "-boost" || option == "-texres") {
      take_numbers(rest, 1, v);
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc" ||
               option == "-clamp" || option == "-imfchan" || option == "-type" ||
               option == "-colorspace") {
      take_word(rest);
    } else {
      break;
    }
    text = rest;
  }
  std::string name(city::trim(text));
  std::replace(name.begin(), name.end(), '\\', '/');
  if (!name.empty() && !std::filesystem::path(name).is_absolute())
    texture.file = (folder_of_file / name).lexically_normal().generic_string();
  return texture;
}

}  // namespace

void read_materials(const std::filesystem::path& file, const std::filesystem::path& folder,
                    std::map<std::string, Material>& materials) {
  const std::filesystem::path below = file.parent_path().lexically_relative(folder);
  const std::filesystem::path folder_of_file = below == "." ? std::filesystem::path() : below;
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
      current->texture = read_texture(line, folder_of_file);
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

std::vector<std::filesystem::path> find_libraries(const std::filesystem::path& obj,
                                                  std::string_view names,
                                                  std::vector<std::string>& absent) {
  std::vector<std::string> tries{std::string(city::trim(names))};
  if (find_library(obj, tries.front()).empty()) {
    tries.clear();
    for (std::string_view word; !(word = take_word(names)).empty();) tries.emplace_back(word);
  }
  std::vector<std::filesystem::path> files;
  for (const std::string& name : tries) {
    if (std::filesystem::path file = find_library(obj, name); !file.empty())
      files.push_back(std::move(file));
    else
      absent.push_back(name);
  }
  return files;
}

}  // namespace nightcity::obj
