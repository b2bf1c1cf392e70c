#include "tools/exports/ies_text.h"

#include <fmt/format.h>

#include <vector>

namespace nightcity::exports {
namespace {

// Numbers a line, so that lines stay below the 132 characters that LM-63 allows.
constexpr std::size_t numbers_a_line = 8;

void append(std::string& text, const std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += fmt::format("{:.7g}{}", numbers[i],
                        (i + 1) % numbers_a_line == 0 || i + 1 == numbers.size() ? "\r\n" : " ");
}

}  // namespace

std::string to_ies_text(const LightProfile& profile, std::span<const float> profile_data) {
  const std::size_t rows = profile.gamma_count;
  const double extent = double{profile.extent_deg};
  std::vector<double> vertical, horizontal;
  for (std::size_t g = 0; g < rows; ++g)
    vertical.push_back(extent * static_cast<double>(g) / static_cast<double>(rows - 1));
  const double end = extent <= 90 ? 90 : 180;
  const bool ends_early = extent < end;
  if (ends_early) {
    const double edge = extent + 0.001;  // the step from the last row to darkness
    if (edge < end) vertical.push_back(edge);
    vertical.push_back(end);
  }
  const std::size_t planes = profile.c_count == 1 ? 1 : profile.c_count + std::size_t{1};
  for (std::size_t c = 0; c < planes; ++c)
    horizontal.push_back(360.0 * static_cast<double>(c) / profile.c_count);

  std::string text = fmt::format(
      "IESNA:LM-63-2002\r\n[TEST] none\r\n[TESTLAB] none\r\n[ISSUEDATE] none\r\n"
      "[MANUFAC] nightcity\r\nTILT=NONE\r\n1 -1 1 {} {} 1 2 0 0 0\r\n1 1 0\r\n",
      vertical.size(), horizontal.size());
  append(text, vertical);
  append(text, horizontal);
  for (std::size_t c = 0; c < planes; ++c) {
    std::vector<double> candela;
    for (std::size_t g = 0; g < vertical.size(); ++g) {
      // C counts anticlockwise seen from above in these files, and clockwise in a light file.
      const std::size_t plane = (planes - 1 - c) % profile.c_count;
      const std::size_t at = profile.data_offset + plane * rows + g;
      candela.push_back(g < rows ? ies_flux_lm * double{profile_data[at]} : 0);
    }
    append(text, candela);
  }
  return text;
}

}  // namespace nightcity::exports
