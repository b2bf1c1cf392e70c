// Answers of servers that serve features of CityJSON (OGC API Features, as 3DBAG's).
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tools/city/byte_source.h"

namespace nightcity::cityjson {

struct ApiAnswer {
  city::Document sequence;  // the same as CityJSONSeq
  std::string missing;  // says that the server gave a part alone, with the remedy; "": it gave all
};

/// Returns what an answer holds that has features ("feature" or "features") beside the header of
/// their sequence ("metadata"); empty for any other document. Throws Error for one of more than
/// `max_bytes`.
std::optional<ApiAnswer> read_api_answer(const city::Document& document, std::size_t max_bytes);

}  // namespace nightcity::cityjson
