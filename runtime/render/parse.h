// Text from command lines and lists to values. What is not understood throws UsageError, which
// names the option. Numbers are what formats/number_text.h reads: blanks may only follow the commas
// of a list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::render {

/// Converts a word to a number from `min` to `max`, both included. NaN is refused.
double parse_number(const std::string& option, const std::string& word, double min, double max);

/// Converts a word to a whole number from `min` to `max`, both included.
std::size_t parse_count(const std::string& option, const std::string& word, std::size_t min,
                        std::size_t max);

/// Converts "yes" or "no".
bool parse_yes_or_no(const std::string& option, const std::string& word);

/// Splits "1,2,4" into its words. Empty words are refused.
std::vector<std::string> split_list(const std::string& option, const std::string& text);

/// Converts a list of whole numbers, as "1,2,4".
std::vector<std::size_t> parse_counts(const std::string& option, const std::string& text,
                                      std::size_t min, std::size_t max);

/// Converts "HH:MM" or "HH:MM:SS" (seconds may have a fraction) to seconds since noon.
double parse_time(const std::string& text);
/// Returns what parse_time takes, "HH:MM:SS" in whole seconds.
std::string time_text(double time_s);

/// Converts an exposure in EV100, -20 to 40; "auto" is nothing.
std::optional<float> parse_exposure(const std::string& text);

struct PictureSize {
  std::uint32_t width = 0, height = 0;  // pixels
};

/// Converts "WIDTHxHEIGHT", of at most max_image_side each.
PictureSize parse_size(const std::string& text);

/// The moon's direction and illuminance.
struct MoonPosition {
  double azimuth_deg = 0;    // from north over east
  double elevation_deg = 0;  // above the horizon, 0 excluded
  double lux = 0.25;         // on a surface that faces it; 0.25 is a full moon
};

/// Converts "AZIMUTH,ELEVATION" or "AZIMUTH,ELEVATION,LUX".
MoonPosition parse_moon(const std::string& text);

}  // namespace nightcity::render
