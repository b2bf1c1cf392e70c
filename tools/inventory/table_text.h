// Texts of tables in forms that GDAL misreads, put into one that it reads.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::inventory {

/// Returns whether a CSV whose first bytes are `start` is to be put into another form: it begins
/// with "sep=;", a comment behind '#' or blank lines, has bars between its columns, one column
/// alone, headings of several lines, cells as formulas (="13.4"), or marks of seconds in cells
/// without quotation marks (13°24'03.6").
bool is_odd_csv(std::string_view start);

/// Takes "sep=;", comments and blank lines from the beginning of a CSV, makes tabs of the bars
/// between its columns, adds a second column to one alone, makes one line of its headings, and
/// double primes of its marks of seconds, and takes '=' from its formulas.
void straighten_csv(std::string& text);

}  // namespace nightcity::inventory
