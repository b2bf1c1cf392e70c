// Finds what a server says of rows that are not in its answer.
#pragma once

#include <simdjson.h>

#include <cstddef>
#include <string>

namespace nightcity::inventory {

/// Returns what an answer in JSON lacks, by what stands beside its `rows` rows in `beside` and in
/// the paging information below; "" where it says nothing of others.
std::string find_missing_rows(const simdjson::dom::object& beside, std::size_t rows);

}  // namespace nightcity::inventory
