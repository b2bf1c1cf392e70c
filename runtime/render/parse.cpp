#include "runtime/render/parse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "formats/error.h"
#include "formats/number_text.h"
#include "runtime/measure/limits.h"

namespace nightcity::render {
namespace {

// Two digits at most, as in a clock's time.
bool read_two_digits(const std::string& text, unsigned max, unsigned& value) {
  const auto digits = text.size() <= 2 ? read_count(text) : std::nullopt;
  if (!digits || *digits > max) return false;
  value = static_cast<unsigned>(*digits);
  return true;
}

bool read_seconds(const std::string& text, double& seconds) {
  const auto value = text.starts_with('+') ? std::nullopt : read_number(text);
  if (!value || !(*value >= 0 && *value < 60) || std::signbit(*value)) return false;
  seconds = *value;
  return true;
}

bool read_side(const std::string& text, std::uint32_t& side) {
  const auto value = read_count(text);
  if (!value || *value < 1 || *value > measure::max_image_side) return false;
  side = static_cast<std::uint32_t>(*value);
  return true;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

// Splits a list. Blanks may follow a comma.
std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> words = split(text, ',');
  for (std::size_t n = 1; n < words.size(); ++n)
    words[n].erase(0, std::min(words[n].find_first_not_of(' '), words[n].size()));
  return words;
}

std::string print_bound(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

double parse_number(const std::string& option, const std::string& word, double min, double max) {
  const auto value = read_number(word);
  if (!value || *value < min || *value > max)
    throw UsageError(option, "'" + word + "' is not a number from " + print_bound(min) + " to " +
                                 print_bound(max));
  return *value;
}

std::size_t parse_count(const std::string& option, const std::string& word, std::size_t min,
                        std::size_t max) {
  const auto value = read_count(word);
  if (!value || *value < min || *value > max)
    throw UsageError(option, "'" + word + "' is not a whole number from " + std::to_string(min) +
                                 " to " + std::to_string(max));
  return *value;
}

bool parse_yes_or_no(const std::string& option, const std::string& word) {
  if (word != "yes" && word != "no")
    throw UsageError(option, "'" + word + "' is neither yes nor no");
  return word == "yes";
}

std::vector<std::string> split_list(const std::string& option, const std::string& text) {
  const std::vector<std::string> words = split_at_commas(text);
  if (std::find(words.begin(), words.end(), "") != words.end())
    throw UsageError(option, "'" + text + "' has an empty entry");
  return words;
}

std::vector<std::size_t> parse_counts(const std::string& option, const std::string& text,
                                      std::size_t min, std::size_t max) {
  std::vector<std::size_t> counts;
  for (const std::string& word : split_list(option, text))
    counts.push_back(parse_count(option, word, min, max));
  return counts;
}

double parse_time(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  unsigned hours = 0, minutes = 0;
  double seconds = 0;
  bool good = (parts.size() == 2 || parts.size() == 3) && read_two_digits(parts[0], 23, hours) &&
              read_two_digits(parts[1], 59, minutes);
  if (good && parts.size() == 3) good = read_seconds(parts[2], seconds);
  if (!good) throw UsageError("--time", "expected HH:MM or HH:MM:SS, not '" + text + "'");
  return ((hours + 12) % 24) * 3600.0 + minutes * 60.0 + seconds;
}

std::string time_text(double time_s) {
  const long seconds = std::lround(time_s) + 12 * 3600;
  const auto two = [](long n) { return (n < 10 ? "0" : "") + std::to_string(n); };
  return two(seconds / 3600 % 24) + ":" + two(seconds / 60 % 60) + ":" + two(seconds % 60);
}

std::optional<float> parse_exposure(const std::string& text) {
  if (text == "auto") return std::nullopt;
  try {
    return static_cast<float>(parse_number("--ev", text, -20, 40));
  } catch (const UsageError&) {
    throw UsageError("--ev", "'" + text + "' is neither auto nor a number from -20 to 40");
  }
}

PictureSize parse_size(const std::string& text) {
  PictureSize size;
  const std::vector<std::string> parts = split(text, 'x');
  if (parts.size() != 2 || !read_side(parts[0], size.width) || !read_side(parts[1], size.height))
    throw UsageError("--size", "expected WIDTHxHEIGHT with 1 to " +
                                   std::to_string(measure::max_image_side) +
                                   " pixels a side, not '" + text + "'");
  return size;
}

MoonPosition parse_moon(const std::string& text) {
  const std::vector<std::string> parts = split_at_commas(text);
  MoonPosition moon;
  const std::array<double*, 3> values = {&moon.azimuth_deg, &moon.elevation_deg, &moon.lux};
  bool good = parts.size() == 2 || parts.size() == 3;
  for (std::size_t n = 0; good && n < parts.size(); ++n) {
    const auto value = read_number(parts[n]);
    good = value.has_value();
    if (good) *values[n] = *value;
  }
  if (!good || !(moon.azimuth_deg >= -360 && moon.azimuth_deg <= 360) ||
      !(moon.elevation_deg > 0 && moon.elevation_deg <= 90) || !(moon.lux > 0 && moon.lux <= 1000))
    throw UsageError(
        "--moon",
        "expected AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,LUX with an elevation above 0, not '" +
            text + "'");
  return moon;
}

}  // namespace nightcity::render
