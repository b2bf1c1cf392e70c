// nightbake readers: both CityGML readers over the same files, and where they disagree.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/citygml/compare_readers.h"
#include "tools/inputs/city_files.h"
#include "tools/nightbake/commands.h"

namespace nightcity {
namespace {

using nlohmann::ordered_json;

struct ReadersArguments {
  std::vector<std::string> files;
  int lod = 2;
  bool json = false, all = false;
};

constexpr std::size_t shown_ids = 5;  // of those only one reader has; --json has all

ordered_json tally_json(const ReaderTally& tally) {
  return {{"objects", tally.objects}, {"polygons", tally.polygons}, {"area", tally.area}};
}

ordered_json reading_json(const ReadReport& report) {
  return {{"objects", report.objects},
          {"polygons", report.polygons},
          {"skipped", report.skipped},
          {"warnings", report.warnings}};
}

ordered_json comparison_json(const std::filesystem::path& file,
                             const ReaderComparison& comparison) {
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

void print_skipped(const char* reader, const ReadReport& report) {
  std::vector<std::pair<std::string, std::size_t>> sorted(report.skipped.begin(),
                                                          report.skipped.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, count] : sorted)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  fmt::print("  {} did not use: {}\n", reader, text.empty() ? "nothing" : text);
}

// One line a type: where the readers agree one of figures, where not both.
void print_tallies(const char* what,
                   const std::map<std::string, std::pair<ReaderTally, ReaderTally>>& tallies,
                   bool all) {
  for (const auto& [type, both] : tallies) {
    const auto& [stream, other] = both;
    if (alike(stream, other) && !all) continue;
    fmt::print("  {:<9}{:<24}{:>9}{:>9}  {:>10}{:>10}  {:>14.3f}{:>14.3f}{}\n", what, type,
               stream.objects, other.objects, stream.polygons, other.polygons, stream.area,
               other.area, alike(stream, other) ? "" : "  differ");
  }
}

void print(const std::filesystem::path& file, const ReaderComparison& comparison, bool all) {
  const ReadReport &stream = comparison.stream, &other = comparison.libcitygml;
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
      const ReaderComparison comparison = compare_readers(file, arguments.lod);
      ++count;
      disagreeing += !comparison.agree();
      if (arguments.json)
        documents.push_back(comparison_json(file, comparison));
      else
        print(file, comparison, arguments.all);
    }
  }
  if (arguments.json)
    fmt::print("{}\n", documents.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  else if (count > 1)
    fmt::print("{} files, the readers disagree on {}\n", count, disagreeing);
}

}  // namespace

void add_readers_command(CLI::App& app) {
  auto* command = app.add_subcommand("readers",
                                     "Read CityGML with both readers and tell where they disagree: "
                                     "objects, polygons, area by type");
  auto arguments = std::make_shared<ReadersArguments>();
  command->add_option("files", arguments->files, "CityGML files, or folders of them")->required();
  command->add_option("--lod", arguments->lod, "The highest level of detail looked at")
      ->capture_default_str()
      ->check(CLI::Range(0, 4));
  command->add_flag("--all", arguments->all, "Show what they agree on too");
  command->add_flag("--json", arguments->json, "Print JSON: one object a file");
  command->footer(
      "The stream reader is the one bakes use; libcitygml 2.4.3 is the second opinion. A "
      "disagreement is no\n"
      "failure: the exit code is 0.\n\nExamples:\n  nightbake readers berlin/3910_5819.gml\n"
      "  nightbake readers --json tiles/ | jq '.[] | select(.agree | not) | .file'");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity
