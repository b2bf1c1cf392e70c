#include "tools/survey/new_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "formats/program/toml_file.h"

namespace nightcity::survey {
namespace {

namespace fs = std::filesystem;

// A comment, wrapped, whatever the text holds.
std::string comment(const std::string& text) {
  constexpr std::size_t width = 100;
  std::string out, line = "#";
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(" \n\r\t", at), text.size());
    std::string word = text.substr(at, end - at);
    std::erase_if(word, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    if (line.size() + 1 + word.size() > width && line != "#") {
      out += line + "\n";
      line = "#";
    }
    if (!word.empty()) line += " " + word;
    at = end + 1;
  }
  return out + line + "\n";
}

class Writer {
 public:
  Writer(const Plan& plan, const fs::path& folder) : plan_(plan), folder_(folder) {}

  std::string write() {
    text_ = comment("Made by nightbake new. `nightbake recipe` explains every key.");
    for (const std::string& missing : plan_.missing) text_ += comment("Missing: " + missing);
    write_city();
    write_map();
    if (!plan_.rasters.empty()) {
      text_ += "\n[terrain]\n";
      describe(plan_.rasters);
      text_ += "dem = " + list(plan_.rasters);
    }
    write_luminaires();
    for (const SurveyedFile* file : plan_.inventories) write_inventory(*file);
    text_ += "\n" + comment("Vehicles on the streets:") + "# [traffic]\n";
    write_left_out();
    return text_;
  }

 private:
  std::string to_name(const fs::path& file) const {
    std::error_code error;
    const fs::path absolute = fs::absolute(file, error).lexically_normal();
    const fs::path relative =
        absolute.lexically_relative(fs::absolute(folder_, error).lexically_normal());
    return (relative.empty() ? absolute : relative).generic_string();
  }

  void describe(const Plan::Files& files) {
    std::map<std::string, std::vector<std::string>> by_kind;
    for (const SurveyedFile* file : files)
      by_kind[file->what].push_back(file->path.filename().string());
    for (const auto& [what, names] : by_kind)
      text_ += comment(
          (names.size() > 1 ? fmt::format("{} files: ", names.size()) : names.front() + ": ") +
          what);
  }

  std::string list(const Plan::Files& files) const {
    std::string text = "[";
    for (const SurveyedFile* file : files)
      text += (text.size() > 1 ? ",\n  " : (files.size() > 1 ? "\n  " : "")) +
              program::quote_for_toml(to_name(file->path));
    return text + (files.size() > 1 ? ",\n]\n" : "]\n");
  }

  // Returns the one folder that stands for all models; empty where there is none.
  fs::path find_common_folder() const {
    constexpr std::size_t many = 20;
    if (plan_.cities.size() <= many) return {};
    const fs::path folder = plan_.cities.front()->path.parent_path();
    for (const SurveyedFile* city : plan_.cities)
      if (city->path.parent_path() != folder) return {};
    for (const auto& [file, why] : plan_.left_out)
      if (file->use == Use::city && file->path.parent_path() == folder) return {};
    return folder;
  }

  void write_city() {
    if (plan_.cities.empty()) return;
    text_ += "\n[city]\n";
    describe(plan_.cities);
    const fs::path folder = find_common_folder();
    text_ += "files = " + (folder.empty() ? list(plan_.cities)
                                          : "[" + program::quote_for_toml(to_name(folder)) + "]\n");
    const auto is_obj = [](const SurveyedFile* f) { return f->is_obj; };
    if (std::none_of(plan_.cities.begin(), plan_.cities.end(),
                     [](const SurveyedFile* f) { return f->has_crs; }))
      text_ += comment("The files name no CRS. With it, lamps and streets find their place:") +
               "# crs = \"EPSG:25833\"\n";
    if (std::any_of(plan_.cities.begin(), plan_.cities.end(), is_obj))
      text_ += comment("An OBJ states neither unit nor axes nor place:") +
               "# obj_up = \"y\"\n# obj_unit_m = 1\n# obj_origin = [391000, 5819000, 35]\n";
    text_ += comment("The attribution that both output files carry:") + "# licence = \"\"\n";
  }

  void write_map() {
    if (plan_.maps.empty()) return;
    text_ += "\n[osm]\n";
    describe(plan_.maps);
    text_ += "files = " + list(plan_.maps);
  }

  void write_luminaires() {
    for (const SurveyedFile* file : plan_.luminaires)
      text_ += "\n" +
               comment(file->path.filename().string() + ": " + file->what +
                       ". Which lamps have it? roads, types and models say it.") +
               "# [[lamps.luminaires]]\n# file = " + program::quote_for_toml(to_name(file->path)) +
               "\n";
  }

  void write_inventory(const SurveyedFile& file) {
    const inventory::InventoryFile& inventory = *file.inventory;
    text_ +=
        "\n[[lamps.inventories]]\n" + comment(file.path.filename().string() + ": " + file.what);
    text_ += "file = " + program::quote_for_toml(to_name(file.path)) + "\n";
    if (!inventory.layer.empty())
      text_ += "layer = " + program::quote_for_toml(inventory.layer) + "\n";
    if (!inventory.crs.empty()) text_ += "crs = " + program::quote_for_toml(inventory.crs) + "\n";
    if (!inventory.id.empty()) text_ += "id = " + program::quote_for_toml(inventory.id) + "\n";
    if (!inventory.columns.empty()) {
      std::string columns;
      for (const auto& [property, column] : inventory.columns)
        columns +=
            (columns.empty() ? "" : ", ") + property + " = " + program::quote_for_toml(column);
      text_ += comment("As the columns' names suggest:") + "columns = {" + columns + "}\n";
    }
    if (inventory.columns.contains("height"))
      text_ += comment("\"ft\" where heights are in feet:") + "height_unit = \"m\"\n";
    text_ += "# licence = \"\"\n";
  }

  void write_left_out() {
    if (plan_.left_out.empty()) return;
    text_ += "\n" + comment("Left out:");
    for (const auto& [file, why] : plan_.left_out)
      text_ += comment(to_name(file->path) + " (" + file->what + ") " + why);
  }

  const Plan& plan_;
  const fs::path& folder_;
  std::string text_;
};

}  // namespace

std::string make_recipe_text(const Plan& plan, const fs::path& folder) {
  return Writer(plan, folder).write();
}

}  // namespace nightcity::survey
