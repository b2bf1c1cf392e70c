#include "tools/city/length_unit.h"

#include <string>
#include <unordered_map>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

namespace nightcity::city {
namespace {

constexpr double us_survey_foot = 1200.0 / 3937.0;

// Returns the text with the brackets that URLs write as %5B and %5D.
std::string decode_brackets(std::string text) {
  for (const auto& [code, bracket] : {std::pair("%5b", "["), std::pair("%5d", "]")})
    for (auto at = text.find(code); at != std::string::npos; at = text.find(code))
      text.replace(at, 3, bracket);
  return text;
}

}  // namespace

std::optional<double> find_metres_per_word(std::string_view word) {
  // 9001 to 9003: codes of EPSG. [ft_i]: UCUM.
  static const std::unordered_map<std::string_view, double> table{
      {"", 1},
      {"m", 1},
      {"metre", 1},
      {"metres", 1},
      {"meter", 1},
      {"meters", 1},
      {"metro", 1},
      {"metros", 1},
      {"metri", 1},
      {"mètre", 1},
      {"mètres", 1},
      {"mt", 1},
      {"mts", 1},
      {"mtr", 1},
      {"mtrs", 1},
      {"méter", 1},
      {"metr", 1},
      {"metry", 1},
      {"metrów", 1},
      {"метр", 1},
      {"метра", 1},
      {"метров", 1},
      {"метри", 1},
      {"метрів", 1},
      {"米", 1},
      {"公尺", 1},
      {"メートル", 1},
      {"미터", 1},
      {"م", 1},
      {"متر", 1},
      {"\xd0\xbc", 1},
      {"\xd0\x9c", 1},
      {"masl", 1},
      {"msl", 1},
      {"9001", 1},
      {"mm", 0.001},
      {"millimetre", 0.001},
      {"millimetres", 0.001},
      {"millimeter", 0.001},
      {"millimeters", 0.001},
      {"cm", 0.01},
      {"centimetre", 0.01},
      {"centimetres", 0.01},
      {"centimeter", 0.01},
      {"centimeters", 0.01},
      {"dm", 0.1},
      {"decimetre", 0.1},
      {"decimetres", 0.1},
      {"decimeter", 0.1},
      {"decimeters", 0.1},
      {"km", 1000},
      {"kilometre", 1000},
      {"kilometres", 1000},
      {"kilometer", 1000},
      {"kilometers", 1000},
      {"'", 0.3048},
      {"ft", 0.3048},
      {"foot", 0.3048},
      {"feet", 0.3048},
      {"[ft_i]", 0.3048},
      {"9002", 0.3048},
      {"international foot", 0.3048},
      {"international feet", 0.3048},
      {"in", 0.0254},
      {"inch", 0.0254},
      {"inches", 0.0254},
      {"[in_i]", 0.0254},
      {"\"", 0.0254},
      {"''", 0.0254},
      {"yd", 0.9144},
      {"yard", 0.9144},
      {"yards", 0.9144},
      {"[ft_us]", us_survey_foot},
      {"9003", us_survey_foot},
      {"us survey foot", us_survey_foot},
      {"us survey feet", us_survey_foot},
      {"us_survey_foot", us_survey_foot},
      {"us_survey_feet", us_survey_foot},
      {"u.s. survey foot", us_survey_foot},
      {"u.s. survey feet", us_survey_foot},
      {"survey foot", us_survey_foot},
      {"survey feet", us_survey_foot},
      {"survey_foot", us_survey_foot},
      {"foot_survey", us_survey_foot},
      {"foot_us", us_survey_foot},
      {"feet_us", us_survey_foot},
      {"us-ft", us_survey_foot},
      {"us-foot", us_survey_foot},
      {"us foot", us_survey_foot},
      {"us feet", us_survey_foot},
      {"us ft", us_survey_foot},
      {"us_ft", us_survey_foot},
      {"usft", us_survey_foot},
      {"ftus", us_survey_foot},
      {"ft_us", us_survey_foot},
      {"sft", us_survey_foot},
  };
  const auto at = table.find(word);
  return at == table.end() ? std::nullopt : std::optional(at->second);
}

std::optional<double> find_metres_per(std::string_view unit) {
  const std::string lower = decode_brackets(to_lower(trim(unit)));
  std::string_view name = lower;
  if (const auto before = name.find_last_of(":#/"); before != std::string_view::npos)
    name.remove_prefix(before + 1);
  if (const auto metres = find_metres_per_word(name)) return metres;
  for (const std::string_view pair : {"[]", "()", "\"\""})
    if (name.size() > 2 && name.front() == pair[0] && name.back() == pair[1])
      if (const auto metres = find_metres_per_word(trim(name.substr(1, name.size() - 2))))
        return metres;
  // It says what the heights are above, or the unit's sign: "meters above sea level", "metre (m)".
  const auto end = name.find_first_of(" ,(");
  return end == 0 || end == std::string_view::npos ? std::nullopt
                                                   : find_metres_per_word(name.substr(0, end));
}

}  // namespace nightcity::city
