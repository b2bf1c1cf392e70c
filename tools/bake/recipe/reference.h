// The reference of all recipe keys, made from the keys that the reader uses.
#pragma once

#include <string>

namespace nightcity::recipe {

/// Returns the reference as Markdown: for each table a heading, what it is, its keys, an example.
/// docs/recipe.md holds it verbatim.
std::string make_markdown_reference();

/// Returns the reference as text for a terminal, 80 columns wide. `word` selects: "" everything,
/// otherwise the table ("city") or the keys ("tile_m", "city.tile_m") of that name. Throws
/// UsageError when nothing has that name.
std::string make_text_reference(const std::string& word);

}  // namespace nightcity::recipe
