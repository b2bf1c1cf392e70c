#include "runtime/nightview/knobs.h"

#include <fmt/format.h>

#include <charconv>

#include <charconv>

#include "formats/error.h"

namespace nightcity {
namespace {

template <auto member, int least, int most>
void number(RenderSettings& settings, const Knob& knob, const std::string& word) {
  auto value = settings.*member;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || rest != end || !(double(value) >= least) || !(double(value) <= most))
    throw UsageError(std::string("--") + knob.name,
                     fmt::format("'{}' is not a number from {} to {}", word, least, most));
  settings.*member = value;
}

template <bool RenderSettings::*member>
void yes_or_no(RenderSettings& settings, const Knob& knob, const std::string& word) {
  if (word != "yes" && word != "no")
    throw UsageError(std::string("--") + knob.name, "'" + word + "' is neither yes nor no");
  settings.*member = word == "yes";
}

void estimator(RenderSettings& settings, const Knob&, const std::string& word) {
  settings.estimator = estimator_from_name(word);
}

using S = RenderSettings;

}  // namespace

const std::vector<Knob>& knobs() {
  static const std::vector<Knob> all{
      {"estimator", "Estimators", "ris,paper,basic,pairwise,traced", estimator},
      {"candidates", "Light candidates a pixel and frame", "4,16,32",
       number<&S::candidates, 1, int(max_candidates)>},
      {"neighbours", "Pixels reused a pixel and frame", "1,5",
       number<&S::neighbours, 0, int(max_neighbours)>},
      {"radius", "How far neighbours are looked for, pixels",
       fmt::format("{}", S{}.neighbour_radius_px), number<&S::neighbour_radius_px, 1, 1000>},
      {"history", "Weight of the frames before, in frames", fmt::format("{}", S{}.history_cap),
       number<&S::history_cap, 0, 1000>},
      {"reach", "Distance at which half of the history counts, m", fmt::format("{}", S{}.reach_m),
       number<&S::reach_m, 0, 100000>},
      {"boost", "Pixels reused by a pixel without history", fmt::format("{}", S{}.boost),
       number<&S::boost, 0, int(max_neighbours)>},
      {"permute", "Reuse the history in changing order, yes or no", "no", yes_or_no<&S::permute>},
      {"local-share", "Share of candidates from the lights near the place",
       fmt::format("{}", S{}.local_share), number<&S::local_share, 0, 1>},
      {"wide-share", "Share of candidates from the lights of the quarter around it",
       fmt::format("{}", S{}.wide_share), number<&S::wide_share, 0, 1>},
      {"uniform-share", "Share of candidates picked uniformly",
       fmt::format("{}", S{}.uniform_share), number<&S::uniform_share, 0, 1>},
      {"fleet-share", "Share of candidates from vehicles' lights",
       fmt::format("{}", S{}.fleet_share), number<&S::fleet_share, 0, 1>},
      {"visibility-reuse", "Drop shadowed candidates before reuse, yes or no", "no",
       yes_or_no<&S::visibility_reuse>},
  };
  return all;
}

std::vector<std::string> split_list(const std::string& option, const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    words.push_back(text.substr(at, comma - at));
    if (words.back().empty()) throw UsageError(option, "'" + text + "' has an empty entry");
    at = comma + 1;
  }
  return words;
}

std::size_t count_of(const std::string& option, const std::string& word, std::size_t least,
                     std::size_t most) {
  std::size_t value = 0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc() || end != word.data() + word.size() || value < least || value > most)
    throw UsageError(option, fmt::format("'{}' is not a number from {} to {}", word, least, most));
  return value;
}

}  // namespace nightcity
