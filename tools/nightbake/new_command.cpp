// nightbake new: a recipe for files that someone has.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/program/output.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/nightbake/commands.h"
#include "tools/survey/new_recipe.h"
#include "tools/survey/plan.h"
#include "tools/survey/survey.h"

namespace nightcity::nightbake {
namespace {

struct NewArguments {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;
  bool force = false;
};

void print_survey(const std::vector<survey::SurveyedFile>& files) {
  std::size_t companions = 0;
  for (const survey::SurveyedFile& file : files) {
    if (file.use == survey::Use::companion) {
      ++companions;
      continue;
    }
    const char* mark = file.use == survey::Use::nothing ? "not used: " : "";
    fmt::print("{}: {}{}\n", file.path.string(), mark, file.what);
  }
  if (companions > 0) fmt::print("{} files that belong to others or are documents\n", companions);
}

void print_plan(const survey::Plan& plan) {
  for (const auto& [file, why] : plan.left_out)
    fmt::print("left out: {}: {}\n", file->path.string(), why);
  for (const std::string& missing : plan.missing) fmt::print("missing: {}\n", missing);
}

void write_new_recipe(const NewArguments& arguments) {
  const std::filesystem::path recipe = arguments.folder / "recipe.toml";
  std::error_code error;
  if (std::filesystem::is_regular_file(arguments.folder, error))
    throw UsageError(arguments.folder.string(),
                     "is a file: name the folder of the recipe first, and then the files");
  if (std::filesystem::exists(recipe, error) && !arguments.force)
    throw UsageError(recipe.string(), "is there already: --force replaces it");
  const auto files = survey::survey_files(arguments.files);
  print_survey(files);
  const survey::Plan plan = survey::make_plan(files);
  print_plan(plan);
  if (plan.is_empty())
    throw Error(arguments.files.front().string(),
                "no city can be made of this: neither a city model (CityGML, CityJSON, OBJ) nor a "
                "map (OSM) is among the files");
  program::require_writable_folder(arguments.folder);
  AtomicFile file(recipe);
  file.write(survey::make_recipe_text(plan, arguments.folder));
  file.commit();
  bake::read_recipe(recipe);  // what is written must be one
  fmt::print("wrote {0}; next: nightbake run {0} --out {1}\n", recipe.string(),
             (arguments.folder / "night").string());
}

}  // namespace

void add_new_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "new", "Write a recipe for files that you have: DIR/recipe.toml, and say what is missing");
  auto arguments = std::make_shared<NewArguments>();
  command->add_option("dir", arguments->folder, "The folder of the recipe; made where absent")
      ->required();
  command
      ->add_option("files", arguments->files,
                   "Files, or folders of them: city models, maps, elevation models, inventories of "
                   "lamps, photometry; the content decides what each is")
      ->required();
  command->add_flag("--force", arguments->force, "Replace a recipe that is there");
  command->footer("Example: nightbake new mycity downloads/");
  command->callback([arguments] { write_new_recipe(*arguments); });
}

}  // namespace nightcity::nightbake
