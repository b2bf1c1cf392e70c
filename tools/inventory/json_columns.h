// Tables that JSON holds by columns, or by the names of their rows.
#pragma once

#include <simdjson.h>

#include <string>

namespace nightcity::inventory {

/// Returns the rows of an object that holds a table in another way than as a list, as a text in
/// JSON that JsonRows reads; "" where it holds none. It may hold columns, each an object of values
/// by the names of rows (pandas' default, orient="columns") or a list of values; or rows, each an
/// object under its name (orient="index", Firebase), which becomes the column "index". Such a table
/// may be a member of the object. Throws Error, which names `file`, where several members are, or
/// the text would be too large.
std::string turn_into_rows(const simdjson::dom::object& whole, const std::string& file);

}  // namespace nightcity::inventory
