// Prepares a member for libcitygml 2.4.3, which keeps only the tail of a text that arrives in
// pieces.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::citygml {

/// Appends `member` to `out` without its comments, with its CDATA sections as plain text and its
/// entities as private-use characters that restore_entities turns back: each of them would cut the
/// text in pieces. Returns false, and appends nothing, when a text is too long to come in one piece
/// (over 1,000,000 bytes).
bool append_guarded(std::string_view member, std::string& out);

/// Returns `text` with the characters that append_guarded put in place of entities replaced by what
/// the entities stand for.
std::string restore_entities(std::string_view text);

}  // namespace nightcity::citygml
