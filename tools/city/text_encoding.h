// Text in UTF-8, whatever encoding a file has.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tools/city/byte_source.h"

namespace nightcity::city {

/// Returns whether a document's first bytes are UTF-16: a byte order mark, '<' beside a zero byte
/// (XML 1.0, appendix F), or in 16 bytes or more characters of any script with blanks, separators,
/// digits or Latin letters among them, in one order of bytes alone.
bool begins_as_utf16(std::string_view start);
/// The same for UTF-32, whose byte order mark begins with that of UTF-16.
bool begins_as_utf32(std::string_view start);

/// Returns a source of the same document in UTF-8: one in UTF-16 or UTF-32 is translated, any other
/// passes through. Halves of surrogate pairs that stand alone become U+FFFD.
std::unique_ptr<ByteSource> to_utf8(std::unique_ptr<ByteSource> source);

/// Returns the same of a whole text.
std::string to_utf8(std::string text);

/// Returns a source of bytes that have been read already, and then of the rest; null: no rest.
std::unique_ptr<ByteSource> resume(std::string start, std::unique_ptr<ByteSource> rest);

/// Returns a text in UTF-8: as it is where it is valid, else taken as Windows-1252, which holds
/// ISO 8859-1.
std::string decode_text(std::string text);

/// Returns `text` with U+FFFD in place of each byte that is part of no valid UTF-8 sequence
/// (RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF).
std::string to_valid_utf8(std::string text);

}  // namespace nightcity::city
