// Texts of tables in forms that GDAL misreads, put into one that it reads.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::inventory {

/// Returns whether a CSV whose first bytes are `start` is to be put into another form: it begins
/// with "sep=;", a comment behind '#' or blank lines, has bars between its columns, one column
/// alone, headings of several lines, cells as formulas (="13.4"), or stray marks.
bool is_odd_csv(std::string_view start);

/// Returns whether a CSV has quotation marks that neither begin nor end a cell, and are not
/// doubled: 13°24'03.6" without marks round it, or "a 5" pole". Rows behind one would be lost.
bool has_stray_marks(std::string_view text);

/// Takes "sep=;", comments and blank lines from the beginning of a CSV, makes tabs of the bars
/// between its columns, adds a second column to one alone, makes one line of its headings, and
/// double primes of its stray marks, and takes '=' from its formulas.
void straighten_csv(std::string& text);

}  // namespace nightcity::inventory
