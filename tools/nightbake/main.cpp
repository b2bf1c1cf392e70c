// nightbake: turns open city data into a photometric night scene. Its subcommands do the work.
#include "formats/program/run_program.h"
#include "tools/nightbake/commands.h"

int main(int argc, char** argv) {
  nightcity::program::Program nightbake;
  nightbake.name = "nightbake";
  nightbake.description =
      "turns open city data (CityGML, CityJSON, OpenStreetMap) into a photometric night scene";
  nightbake.version = NIGHTCITY_VERSION;
  nightbake.exit_codes =
      "0 done; 1 an input is missing, broken or unusable, or an output cannot be "
      "written;\n"
      "2 the command line or a recipe's keys are wrong.";
  nightbake.add_commands = [](CLI::App& app) {
    nightcity::nightbake::add_run_command(app);
    nightcity::nightbake::add_new_command(app);
    nightcity::nightbake::add_merge_command(app);
    nightcity::nightbake::add_price_command(app);
    nightcity::nightbake::add_recipe_command(app);
    nightcity::nightbake::add_inspect_command(app);
    nightcity::nightbake::add_readers_command(app);
    nightcity::nightbake::add_town_command(app);
    nightcity::nightbake::add_elevate_command(app);
    nightcity::nightbake::add_lamps_command(app);
    nightcity::nightbake::add_layout_command(app);
    nightcity::nightbake::add_traffic_command(app);
    nightcity::nightbake::add_windows_command(app);
    nightcity::nightbake::add_lights_command(app);
    nightcity::nightbake::add_export_command(app);
  };
  return nightcity::program::run_program(nightbake, argc, argv);
}
