#include "tools/citygml/libcitygml_text.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace nightcity::citygml {
namespace {

// Xerces delivers text in pieces of 2^20 characters.
constexpr std::size_t max_text_bytes = 1'000'000;

struct Stand {
  std::string_view entity;  // without & and ;
  char character;
  std::string_view in_place;  // U+E000 ... U+E004
};
constexpr std::array stands{Stand{"amp", '&', "\xEE\x80\x80"}, Stand{"lt", '<', "\xEE\x80\x81"},
                            Stand{"gt", '>', "\xEE\x80\x82"}, Stand{"quot", '"', "\xEE\x80\x83"},
                            Stand{"apos", '\'', "\xEE\x80\x84"}};

const Stand* stand_for(char c) {
  for (const Stand& s : stands)
    if (s.character == c) return &s;
  return nullptr;
}

void append_character(char c, std::string& out) {
  if (const Stand* s = stand_for(c))
    out += s->in_place;
  else
    out += c;
}

void append_utf8(unsigned long code, std::string& out) {
  if (code < 0x20 || code > 0x10FFFF) {
    out += ' ';
  } else if (code < 0x80) {
    append_character(static_cast<char>(code), out);
  } else {
    const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
    if (code < 0x800) {
      out += static_cast<char>(0xC0 | (code >> 6));
    } else if (code < 0x10000) {
      out += static_cast<char>(0xE0 | (code >> 12));
      tail(6);
    } else {
      out += static_cast<char>(0xF0 | (code >> 18));
      tail(12);
      tail(6);
    }
    tail(0);
  }
}

// "#228" or "#xE4", without & and ;
void append_reference(const std::string& reference, std::string& out) {
  const bool hex = reference.size() > 1 && reference[1] == 'x';
  append_utf8(std::strtoul(reference.c_str() + (hex ? 2 : 1), nullptr, hex ? 16 : 10), out);
}

// Text between tags. Entities that are not XML's own are left out: without a DOCTYPE they cannot be
// declared.
void append_text(std::string_view text, std::string& out) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '&') {
      out += text[i];
      continue;
    }
    const auto end = text.find(';', i);
    if (end == std::string_view::npos) return;
    const std::string_view entity = text.substr(i + 1, end - i - 1);
    if (entity.starts_with('#')) append_reference(std::string(entity), out);
    for (const Stand& s : stands)
      if (entity == s.entity) out += s.in_place;
    i = end;
  }
}

}  // namespace

bool append_guarded(std::string_view member, std::string& out) {
  const std::size_t before = out.size();
  std::size_t at = 0, text_begin = before;
  while (at < member.size()) {
    const auto open = std::min(member.find('<', at), member.size());
    append_text(member.substr(at, open - at), out);
    if (out.size() - text_begin > max_text_bytes) {
      out.resize(before);
      return false;
    }
    if (open == member.size()) break;
    const std::string_view rest = member.substr(open);
    if (rest.starts_with("<!--") || rest.starts_with("<?")) {
      const std::string_view closer = rest[1] == '?' ? "?>" : "-->";
      at = open + rest.find(closer, 2) + closer.size();
    } else if (rest.starts_with("<![CDATA[")) {
      const auto end = rest.find("]]>");
      for (const char c : rest.substr(9, end - 9)) append_character(c, out);
      at = open + end + 3;
    } else {
      std::size_t end = 0;  // the '>' outside quotes
      for (char quote = 0; end < rest.size(); ++end) {
        const char c = rest[end];
        if (quote ? c == quote : (c == '"' || c == '\'')) quote = quote ? '\0' : c;
        if (!quote && c == '>') break;
      }
      out += rest.substr(0, end + 1);
      text_begin = out.size();
      at = open + end + 1;
    }
  }
  return true;
}

std::string restore_entities(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const Stand* found = nullptr;
    for (const Stand& s : stands)
      if (text.substr(i).starts_with(s.in_place)) found = &s;
    out += found ? found->character : text[i];
    i += found ? found->in_place.size() : 1;
  }
  return out;
}

}  // namespace nightcity::citygml
