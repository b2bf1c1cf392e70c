// The inputs of a city are shared out among the parts of a bake by their bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/bake/city/city_survey.h"

namespace nightcity::bake {

/// Part `number` of `count`, from 1.
struct Share {
  std::uint32_t number = 1, count = 1;
  bool operator==(const Share&) const = default;
};

/// Parses "3/64". Nothing where the text is no share, or one of more than 100,000.
std::optional<Share> parse_share(std::string_view text);

/// A file of the city, or a piece of one.
struct SharePiece {
  std::size_t file = 0;
  std::optional<city::TextPiece> piece;  // nothing: the whole file
};

/// Returns the share's pieces in file order. All shares of one count hold each object of the city
/// once, in the order of the files, and about as many bytes each. A file that cannot be cut belongs
/// to one share.
std::vector<SharePiece> find_pieces(const CityInputs& inputs, const CitySurvey& survey,
                                    const Share& share);

}  // namespace nightcity::bake
