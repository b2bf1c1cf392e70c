// nightbake readers: reads the same files with both CityGML readers and reports where they
// disagree.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/program/number_check.h"
#include "formats/program/print_json.h"
#include "tools/bake/report/report_text.h"
#include "tools/citygml/compare_readers.h"
#include "tools/inputs/city_files.h"
#include "tools/nightbake/commands.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::ordered_json;

struct ReadersArguments {
  std::vector<std::string> files;
  int lod = 2;
  bool json = false, all = false;
};

// The number of printed ids of objects that only one reader has; --json has all.
constexpr std::size_t shown_ids = 5;

ordered_json tally_json(const citygml::ReaderTally& tally) {
  return {{"objects", tally.objects}, {"polygons", tally.polygons}, {"area", tally.area}};
}

ordered_json reading_json(const city::ReadReport& report) {
  return {{"objects", report.objects},
          {"polygons", report.polygons},
          {"skipped", report.skipped},
          {"warnings", report.warnings}};
}

ordered_json comparison_json(const std::filesystem::path& file,
                             const citygml::ReaderComparison& comparison) {
  ordered_json result = {{"file", file.string()}, {"agree", comparison.agree()}};
  for (const auto& [name, tallies] :
       {std::pair{"objects", &comparison.objects}, std::pair{"surfaces", &comparison.surfaces}}) {
    result[name] = ordered_json::object();
    for (const auto& [type, both] : *tallies)
      result[name][type] = {{"stream", tally_json(both.first)},
                            {"libcitygml", tally_json(both.second)}};
  }
  result["only_in_stream"] = comparison.only_in_stream;
  result["only_in_libcitygml"] = comparison.only_in_libcitygml;
  result["stream"] = reading_json(comparison.stream);
  result["libcitygml"] = reading_json(comparison.libcitygml);
  return result;
}

void print_ids(const char* reader, const std::vector<std::string>& ids) {
  if (ids.empty()) return;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown_ids, ids.size()); ++i) text += " " + ids[i];
  fmt::print("  {} objects only {} has:{}{}\n", ids.size(), reader, text,
             ids.size() > shown_ids ? " ..." : "");
}

void print_skipped(const char* reader, const city::ReadReport& report) {
  fmt::print("  {} skipped: {}\n", reader, bake::in_words(report.skipped));
}

// Prints one line for each type on which the readers disagree; with `all`, for every type.
void print_tallies(
    const char* what,
    const std::map<std::string, std::pair<citygml::ReaderTally, citygml::ReaderTally>>& tallies,
    bool all) {
  for (const auto& [type, both] : tallies) {
    const auto& [stream, other] = both;
    if (citygml::alike(stream, other) && !all) continue;
    fmt::print("  {:<9}{:<24}{:>9}{:>9}  {:>10}{:>10}  {:>14.3f}{:>14.3f}{}\n", what, type,
               stream.objects, other.objects, stream.polygons, other.polygons, stream.area,
               other.area, citygml::alike(stream, other) ? "" : "  differ");
  }
}

void print(const std::filesystem::path& file, const citygml::ReaderComparison& comparison,
           bool all) {
  const city::ReadReport &stream = comparison.stream, &other = comparison.libcitygml;
  fmt::print("{}: {}\n", file.string(),
             comparison.agree() ? fmt::format("the readers agree: {} objects, {} polygons",
                                              stream.objects, stream.polygons)
                                : "the readers disagree");
  if (comparison.agree() && !all) return;
  fmt::print("  {:<33}{:>18}  {:>20}  {:>28}\n", "", "objects", "polygons", "area, file's units^2");
  fmt::print("  {:<33}{:>9}{:>9}  {:>10}{:>10}  {:>14}{:>14}\n", "", "stream", "libcity.", "stream",
             "libcity.", "stream", "libcitygml");
  print_tallies("object", comparison.objects, all);
  print_tallies("surface", comparison.surfaces, all);
  print_ids("stream", comparison.only_in_stream);
  print_ids("libcitygml", comparison.only_in_libcitygml);
  print_skipped("stream", stream);
  print_skipped("libcitygml", other);
}

void run(const ReadersArguments& arguments) {
  ordered_json documents = ordered_json::array();
  std::size_t disagreeing = 0, count = 0;
  for (const std::string& name : arguments.files) {
    for (const auto& file : inputs::city_files(name)) {
      const citygml::ReaderComparison comparison = citygml::compare_readers(file, arguments.lod);
      ++count;
      disagreeing += !comparison.agree();
      if (arguments.json)
        documents.push_back(comparison_json(file, comparison));
      else
        print(file, comparison, arguments.all);
    }
  }
  if (arguments.json)
    program::print_json(documents);
  else if (count > 1)
    fmt::print("{} files, the readers disagree on {}\n", count, disagreeing);
}

}  // namespace

void add_readers_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("readers",
                         "Read CityGML with both readers and print where they disagree: "
                         "objects, polygons, area by type");
  auto arguments = std::make_shared<ReadersArguments>();
  command->add_option("files", arguments->files, "CityGML files, or folders of them")->required();
  command->add_option("--lod", arguments->lod, "The highest level of detail to use")
      ->capture_default_str()
      ->check(program::count_from(0, 4));
  command->add_flag("--all", arguments->all, "Print what they agree on too");
  command->add_flag("--json", arguments->json, "Print JSON: one object per file");
  command->footer(
      "The bake uses the stream reader; libcitygml 2.4.3 is the second opinion. Where they "
      "disagree the "
      "exit code is 0 all the same.\n\nExamples:\n  nightbake readers berlin/3910_5819.gml\n"
      "  nightbake readers --json tiles/ | jq '.[] | select(.agree | not) | .file'");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
