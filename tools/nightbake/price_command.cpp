// nightbake price: what a bake saves by giving something up, and the error of that.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "tools/bake/bake.h"
#include "tools/bake/variants.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/run_nightview.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

namespace fs = std::filesystem;

struct PriceArguments {
  std::string recipe, folder, only, nightview, pictures;
  bool json = false, no_pictures = false;
};

// A bake that was made. The first is the untouched one.
struct PricedBake {
  std::string name, key, help;
  double max_shift_m = 0, bake_s = 0;
  std::uintmax_t glb_bytes = 0, lights_bytes = 0;
  fs::path scene;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, separator);)
    if (!word.empty()) words.push_back(word);
  return words;
}

std::string list_names() {
  std::string names;
  for (const bake::Variant& variant : bake::list_variants())
    names += (names.empty() ? "" : ", ") + std::string(variant.name);
  return names;
}

// Returns the variants that are asked for and give something up in this recipe.
std::vector<const bake::Variant*> choose_variants(const PriceArguments& arguments,
                                                  const bake::Recipe& recipe) {
  const std::vector<std::string> only = split(arguments.only, ',');
  for (const std::string& name : only)
    if (std::none_of(bake::list_variants().begin(), bake::list_variants().end(),
                     [&](const bake::Variant& each) { return name == each.name; }))
      throw UsageError("--only",
                       "there is no variant '" + name + "' (there are " + list_names() + ")");
  std::vector<const bake::Variant*> chosen;
  for (const bake::Variant& variant : bake::list_variants()) {
    const bool is_named = std::find(only.begin(), only.end(), variant.name) != only.end();
    if (!only.empty() && !is_named) continue;
    if (variant.applies(recipe))
      chosen.push_back(&variant);
    else
      spdlog::info("{}: this recipe gives that up already", variant.name);
  }
  return chosen;
}

PricedBake make_bake(const bake::Recipe& recipe, const fs::path& folder) {
  PricedBake made;
  const auto start = std::chrono::steady_clock::now();
  {
    ShownProgress progress;
    bake::bake(recipe, folder, progress.sink());
  }
  made.bake_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  made.scene = folder / "city.glb";
  made.glb_bytes = fs::file_size(made.scene);
  made.lights_bytes = fs::file_size(folder / "city.lights");
  return made;
}

std::vector<PricedBake> make_bakes(const PriceArguments& arguments) {
  const bake::Recipe recipe = bake::read_recipe(arguments.recipe);
  const std::vector<const bake::Variant*> variants = choose_variants(arguments, recipe);
  const fs::path folder(arguments.folder);
  std::vector<PricedBake> bakes{make_bake(recipe, folder / "whole")};
  bakes.back().name = "whole";
  bakes.back().help = "nothing";
  for (const bake::Variant* variant : variants) {
    spdlog::info("{}: {}", variant->name, variant->key);
    bake::Recipe changed = recipe;
    variant->change(changed);
    bakes.push_back(make_bake(changed, folder / variant->name));
    bakes.back().name = variant->name;
    bakes.back().key = variant->key;
    bakes.back().help = variant->help;
    bakes.back().max_shift_m = variant->max_shift_m;
  }
  return bakes;
}

// Returns what nightview price says of each bake against the first, by scene; empty without it.
std::map<std::string, nlohmann::json> measure_pictures(const PriceArguments& arguments,
                                                       const std::vector<PricedBake>& bakes) {
  if (arguments.no_pictures || bakes.size() < 2) return {};
  const fs::path program =
      arguments.nightview.empty() ? find_nightview() : fs::path(arguments.nightview);
  std::vector<std::string> words{"price", bakes[0].scene.string(), "--json"};
  for (std::size_t i = 1; i < bakes.size(); ++i)
    words.insert(words.end(), {"--against", bakes[i].scene.string()});
  for (const std::string& word : split(arguments.pictures, ' ')) words.push_back(word);
  const auto json = run_nightview(program, words);
  if (!json) {
    if (!arguments.nightview.empty())
      throw UsageError("--nightview", "'" + arguments.nightview + "' is no program");
    spdlog::warn("nightview is neither beside nightbake nor in PATH: no pictures are compared");
    return {};
  }
  std::map<std::string, nlohmann::json> rows;
  for (const nlohmann::json& part : json->at("parts")) rows[part.at("name")] = part;
  return rows;
}

std::string to_text(const nlohmann::json& estimate, double factor, const char* format) {
  return fmt::format(fmt::runtime(format), factor * estimate.at("value").get<double>()) + " +- " +
         fmt::format("{:.1g}", factor * estimate.at("standard_error").get<double>());
}

std::string to_markdown(const std::vector<PricedBake>& bakes,
                        const std::map<std::string, nlohmann::json>& pictures) {
  std::string text =
      "| bake | gives up | shift, mm | glb, MB | lights, MB | bake, s | view | mean, % | RMSE "
      "(8-bit) | relative MSE | saves ms | saves MB | saves load s |\n"
      "|---|---|---:|---:|---:|---:|---|---:|---:|---:|---:|---:|---:|\n";
  for (const PricedBake& each : bakes) {
    const std::string begin =
        fmt::format("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} |", each.name, each.help,
                    each.max_shift_m > 0 ? fmt::format("{:g}", 1000 * each.max_shift_m) : "",
                    double(each.glb_bytes) / 1e6, double(each.lights_bytes) / 1e6, each.bake_s);
    const auto row = pictures.find(each.scene.string());
    if (row == pictures.end()) {
      text += begin + " | | | | | | |\n";
      continue;
    }
    const nlohmann::json& saved = row->second;
    for (const nlohmann::json& view : saved.at("views"))
      text += fmt::format(
          "{} {} | {} | {} | {} | {} | {:.2f} | {:+.2f} |\n", begin,
          view.at("view").get<std::string>(),
          to_text(view.at("relative_mean_signed_error"), 100, "{:+.3f}"),
          to_text(view.at("rmse8"), 1, "{:.3f}"), to_text(view.at("relative_mse"), 1, "{:.4g}"),
          to_text(saved.at("saved_ms"), 1, "{:+.3g}"), saved.at("saved_bytes").get<double>() / 1e6,
          saved.at("saved_load_s").get<double>());
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<PricedBake>& bakes,
                               const std::map<std::string, nlohmann::json>& pictures) {
  auto rows = nlohmann::ordered_json::array();
  for (const PricedBake& each : bakes) {
    nlohmann::ordered_json row{{"name", each.name},           {"key", each.key},
                               {"gives_up", each.help},       {"max_shift_m", each.max_shift_m},
                               {"glb_bytes", each.glb_bytes}, {"lights_bytes", each.lights_bytes},
                               {"bake_s", each.bake_s},       {"scene", each.scene.string()}};
    if (const auto picture = pictures.find(each.scene.string()); picture != pictures.end())
      row["pictures"] = picture->second;
    rows.push_back(std::move(row));
  }
  return rows;
}

void price(const PriceArguments& arguments) {
  program::require_writable_folder(arguments.folder);
  const std::vector<PricedBake> bakes = make_bakes(arguments);
  const auto pictures = measure_pictures(arguments, bakes);
  const std::string table = to_markdown(bakes, pictures);
  const nlohmann::ordered_json json = to_json(bakes, pictures);
  const auto write = [&](const char* name, const std::string& text) {
    AtomicFile file(fs::path(arguments.folder) / name);
    file.write(text);
    file.commit();
  };
  write("price.md", table);
  write("price.json", program::to_json_text(json) + "\n");
  if (arguments.json)
    program::print_json(json);
  else
    fmt::print("{}", table);
}

}  // namespace

void add_price_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "price",
      "Bake a recipe with one thing after the other given up, and measure what that saves");
  auto arguments = std::make_shared<PriceArguments>();
  command->add_option("recipe", arguments->recipe, "Recipe (TOML) of the untouched bake")
      ->required();
  program::add_output_option(
      *command, arguments->folder,
      "Folder of the results: price.md, price.json, and the bakes, whole and one folder a variant")
      ->required();
  std::string variants = "Variants, comma-separated; without it all of them:";
  for (const bake::Variant& variant : bake::list_variants())
    variants += std::string("\n  ") + variant.name + ": " + variant.key;
  command->add_option("--only", arguments->only, variants);
  command->add_option("--nightview", arguments->nightview,
                      "nightview, which renders the bakes (default: beside nightbake, or in PATH)");
  command->add_option("--pictures", arguments->pictures,
                      "Further options of nightview price, separated by blanks: \"--size 96x54 "
                      "--frames 16\"");
  command->add_flag("--no-pictures", arguments->no_pictures,
                    "Compare files and bake times alone, without nightview");
  command->add_flag("--json", arguments->json, "Print the results as JSON");
  command->footer(
      "File sizes and bake times are measured here; errors of pictures, frame times, bytes on the "
      "device and\n"
      "load times by nightview price --against, free of noise (docs/price.md).\n"
      "Examples:\n"
      "  nightbake price pipelines/berlin.toml --out out/price\n"
      "  nightbake price city.toml --out out/price --only draco-10mm,lod-1 --pictures \"--size "
      "96x54\"\n"
      "  nightbake price city.toml --out out/price --no-pictures");
  command->callback([arguments] { price(*arguments); });
}

}  // namespace nightcity::nightbake
