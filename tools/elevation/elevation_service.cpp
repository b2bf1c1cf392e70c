#include "tools/elevation/elevation_service.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <unordered_map>

#include "formats/error.h"
#include "formats/input_file.h"
#include "formats/json_parse.h"
#include "formats/median.h"
#include "tools/elevation/http_post.h"

namespace nightcity::elevation {
namespace {

using nlohmann::json;

constexpr double sea_level_m = 10;

/// The cache's key: a place to a decimetre, which is finer than any such service's raster.
std::string key_of(const std::string& url, const glm::dvec2& lon_lat) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6f\t%.6f", lon_lat.y, lon_lat.x);
  return url + '\t' + text;
}

/// A file of lines with url, latitude, longitude and height, separated by tabs. A broken line (the
/// disk was full) is ignored.
class Cache {
 public:
  explicit Cache(const std::filesystem::path& path) : path_(path) {
    if (path.empty()) return;
    refuse_special_file(path);
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      const std::size_t tab = line.rfind('\t');
      double height = 0;
      if (tab == std::string::npos) continue;
      const char *first = line.data() + tab + 1, *last = line.data() + line.size();
      const auto [end, error] = std::from_chars(first, last, height);
      if (error == std::errc() && end == last && std::isfinite(height))
        known_[line.substr(0, tab)] = height;
    }
  }

  std::optional<double> find(const std::string& key) const {
    const auto found = known_.find(key);
    return found == known_.end() ? std::nullopt : std::optional(found->second);
  }

  void add(const std::vector<std::pair<std::string, double>>& answers) {
    if (path_.empty()) return;
    std::ofstream file(path_, std::ios::app);
    for (const auto& [key, height] : answers) file << key << '\t' << json(height).dump() << '\n';
    file.flush();
    if (!file) throw Error(path_.string(), "cannot be written");
  }

 private:
  std::filesystem::path path_;
  std::unordered_map<std::string, double> known_;
};

bool busy(long status) {
  return status == 429 || status == 502 || status == 503 || status == 504;
}

HttpAnswer ask(HttpClient& client, const std::string& body, const ElevationServiceOptions& options,
               ElevationAnswers& answers) {
  auto wait = options.first_wait;
  for (int attempt = 1;; ++attempt) {
    HttpAnswer answer = client.post_json(options.url, body);
    ++answers.requests;
    if (!busy(answer.status)) return answer;
    if (attempt >= options.attempts)
      throw Error(options.url, "stays busy: status " + std::to_string(answer.status) + " after " +
                                   std::to_string(attempt) + " attempts");
    ++answers.retries;
    std::chrono::milliseconds pause = wait;
    if (answer.retry_after_s)
      pause =
          std::max<std::chrono::milliseconds>(pause, std::chrono::seconds(*answer.retry_after_s));
    std::this_thread::sleep_for(std::min<std::chrono::milliseconds>(pause, options.max_wait));
    wait *= 2;
  }
}

/// Returns the heights in an answer to `count` places; null means no data.
std::vector<std::optional<double>> read_answer(const HttpAnswer& answer, std::size_t count,
                                               const std::string& url) {
  if (answer.status != 200)
    throw Error(url, "answers with status " + std::to_string(answer.status));
  const json document = try_parse_json(answer.body);
  if (document.is_discarded() || !document.is_object() || !document.contains("results") ||
      !document["results"].is_array())
    throw Error(url, "answers without a list of results");
  const json& results = document["results"];
  if (results.size() != count)
    throw Error(url, "answers for " + std::to_string(results.size()) + " of " +
                         std::to_string(count) + " places");
  std::vector<std::optional<double>> heights;
  for (const json& result : results) {
    const auto elevation = result.is_object() ? result.find("elevation") : result.end();
    if (!result.is_object() || elevation == result.end() ||
        !(elevation->is_number() || elevation->is_null()))
      throw Error(url, "answers without an elevation");
    heights.push_back(elevation->is_null() ? std::nullopt
                                           : std::optional(elevation->get<double>()));
    if (heights.back() && !(*heights.back() > -500 && *heights.back() < 9000))
      heights.back().reset();
  }
  return heights;
}

void refuse_zeros(ElevationAnswers& answers) {
  std::vector<double> others;
  for (const auto& height : answers.heights)
    if (height && *height != 0) others.push_back(*height);
  if (!others.empty() && std::abs(median(std::move(others))) <= sea_level_m) return;
  for (auto& height : answers.heights)
    if (height && *height == 0) {
      height.reset();
      ++answers.zeros_refused;
    }
}

}  // namespace

ElevationAnswers ask_elevations(std::span<const glm::dvec2> lon_lat,
                                const ElevationServiceOptions& options) {
  ElevationAnswers answers;
  answers.heights.resize(lon_lat.size());
  Cache cache(options.cache);
  std::vector<std::size_t> open;
  for (std::size_t n = 0; n < lon_lat.size(); ++n) {
    answers.heights[n] = cache.find(key_of(options.url, lon_lat[n]));
    if (answers.heights[n])
      ++answers.from_cache;
    else
      open.push_back(n);
  }
  HttpClient client;
  const std::size_t batch = std::max<std::size_t>(options.batch, 1);
  for (std::size_t first = 0; first < open.size(); first += batch) {
    const auto part = std::span(open).subspan(first, std::min(batch, open.size() - first));
    json locations = json::array();
    for (const std::size_t n : part)
      locations.push_back({{"latitude", lon_lat[n].y}, {"longitude", lon_lat[n].x}});
    const HttpAnswer answer = ask(client, json{{"locations", locations}}.dump(), options, answers);
    const auto heights = read_answer(answer, part.size(), options.url);
    std::vector<std::pair<std::string, double>> told;
    for (std::size_t k = 0; k < part.size(); ++k) {
      answers.heights[part[k]] = heights[k];
      if (heights[k]) told.emplace_back(key_of(options.url, lon_lat[part[k]]), *heights[k]);
    }
    cache.add(told);
    if (options.progress) options.progress(std::min(first + batch, open.size()), open.size());
  }
  refuse_zeros(answers);
  return answers;
}

}  // namespace nightcity::elevation
