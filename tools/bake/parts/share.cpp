#include "tools/bake/parts/share.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <numeric>

#include "tools/bake/city/city_inputs.h"

namespace nightcity::bake {

std::optional<Share> parse_share(std::string_view text) {
  constexpr std::uint32_t max_count = 100'000;
  Share share;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, share.number);
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != '/') return {};
  const auto count = std::from_chars(number.ptr + 1, end, share.count);
  if (count.ec != std::errc() || count.ptr != end) return {};
  if (share.number < 1 || share.number > share.count || share.count > max_count) return {};
  return share;
}

std::vector<SharePiece> find_pieces(const CityInputs& inputs, const CitySurvey& survey,
                                    const Share& share) {
  const std::uint64_t all =
      std::accumulate(survey.sizes.begin(), survey.sizes.end(), std::uint64_t{0});
  const auto border = [&](std::uint64_t number) {
    return all / share.count * number + all % share.count * number / share.count;
  };
  const std::uint64_t low = border(share.number - 1), high = border(share.number);
  const bool is_last = share.number == share.count;
  std::vector<SharePiece> pieces;
  std::uint64_t before = 0;  // bytes of the files before this one
  for (std::size_t file = 0; file < survey.sizes.size(); ++file) {
    const std::uint64_t size = survey.sizes[file];
    const std::uint64_t from = before;
    before += size;
    if (const auto& cuts = survey.cuts[file]) {
      const std::uint64_t begin = std::max(low, from), end = std::min(high, from + size);
      if (begin >= end) continue;
      if (begin == from && end == from + size)
        pieces.push_back({file, {}});
      else if (auto piece = city::find_piece(inputs.files[file], *cuts, begin - from, end - from))
        pieces.push_back({file, std::move(piece)});
      continue;
    }
    if (from >= low && (from < high || (is_last && from == high))) pieces.push_back({file, {}});
  }
  return pieces;
}

}  // namespace nightcity::bake
