// nightview: renders a baked city at night. Its subcommands do the work.
#include <algorithm>
#include <string>
#include <vector>

#include "formats/program/run_program.h"
#include "runtime/nightview/commands.h"
#include "runtime/scene/scene_file.h"

namespace nightcity::nightview {
namespace {

// "nightview SCENE.glb ..." is short for "nightview view SCENE.glb ...", and so is a folder's name.
std::vector<std::string> add_default_command(const CLI::App& app,
                                             std::vector<std::string> arguments) {
  const auto is_command = [&app](const std::string& text) {
    return !app.get_subcommands([&](const CLI::App* sub) { return sub->check_name(text); }).empty();
  };
  if (std::none_of(arguments.begin(), arguments.end(), is_command) &&
      std::any_of(arguments.begin(), arguments.end(),
                  [](const std::string& text) { return scene::may_be_scene(text); }))
    arguments.insert(arguments.begin(), "view");
  return arguments;
}

}  // namespace
}  // namespace nightcity::nightview

int main(int argc, char** argv) {
  nightcity::program::Program nightview;
  nightview.name = "nightview";
  nightview.description =
      "renders a baked city at night, with every light of the city as a light source";
  nightview.version = NIGHTCITY_VERSION;
  nightview.exit_codes =
      "0 done; 1 an input is missing, broken or unusable, an output cannot be written, "
      "or\n"
      "there is no usable Vulkan device; 2 the command line is wrong.";
  nightview.add_commands = [](CLI::App& app) {
    nightcity::nightview::add_render_command(app);
    nightcity::nightview::add_view_command(app);
    nightcity::nightview::add_compare_command(app);
    nightcity::nightview::add_bench_command(app);
    nightcity::nightview::add_rays_command(app);
    nightcity::nightview::add_upward_command(app);
    nightcity::nightview::add_devices_command(app);
    nightcity::nightview::add_sweep_command(app);
    nightcity::nightview::add_flight_command(app);
    nightcity::nightview::add_record_command(app);
    nightcity::nightview::add_strategies_command(app);
    nightcity::nightview::add_vehicles_command(app);
    nightcity::nightview::add_price_command(app);
    nightcity::nightview::add_presets_command(app);
  };
  nightview.complete_arguments = nightcity::nightview::add_default_command;
  return nightcity::program::run_program(nightview, argc, argv);
}
