#include "runtime/scene/fold_name.h"

#include <cstddef>
#include <map>

namespace nightcity::scene {
namespace {

struct Row {
  const char* letter;
  std::u32string_view variants;
};

// Latin letters by what is left of them in Unicode's decomposition (NFKD, UnicodeData.txt) without
// combining marks, and those that have none by their usual transcription.
constexpr Row latin[] = {
    {"a", U"ÀÁÂÃÄÅàáâãäåĀāĂăĄąǍǎǺǻȀȁȂȃȦȧḀḁẠạẢảẤấẦầẨẩẪẫẬậẮắẰằẲẳẴẵẶặ"},
    {"ae", U"Ææ"},
    {"b", U"ḂḃḄḅḆḇ"},
    {"c", U"ÇçĆćĈĉĊċČčḈḉ"},
    {"d", U"ÐðĎďĐđḊḋḌḍḎḏḐḑḒḓ"},
    {"e", U"ÈÉÊËèéêëĒēĔĕĖėĘęĚěƏəȄȅȆȇȨȩḔḕḖḗḘḙḚḛḜḝẸẹẺẻẼẽẾếỀềỂểỄễỆệ"},
    {"f", U"Ḟḟ"},
    {"g", U"ĜĝĞğĠġĢģǦǧḠḡ"},
    {"h", U"ĤĥĦħȞȟḢḣḤḥḦḧḨḩḪḫẖ"},
    {"i", U"ÌÍÎÏìíîïĨĩĪīĬĭĮįİıǏǐȈȉȊȋḬḭḮḯỈỉỊị"},
    {"ij", U"Ĳĳ"},
    {"j", U"Ĵĵ"},
    {"k", U"ĶķĸǨǩḰḱḲḳḴḵ"},
    {"l", U"ĹĺĻļĽľŁłḶḷḸḹḺḻḼḽ"},
    {"m", U"ḾḿṀṁṂṃ"},
    {"n", U"ÑñŃńŅņŇňŊŋǸǹṄṅṆṇṈṉṊṋ"},
    {"o",
     U"ÒÓÔÕÖØòóôõöøŌōŎŏŐőƠơǑǒǪǫǬǭȌȍȎȏȪȫȬȭȮȯȰȱṌṍṎṏṐṑṒṓỌọỎỏỐốỒồỔổỖỗỘộ"
     U"ỚớỜờỞởỠỡỢợ"},
    {"oe", U"Œœ"},
    {"p", U"ṔṕṖṗ"},
    {"r", U"ŔŕŖŗŘřȐȑȒȓṘṙṚṛṜṝṞṟ"},
    {"s", U"ŚśŜŝŞşŠšſȘșṠṡṢṣṤṥṦṧṨṩẛ"},
    {"ss", U"ßẞ"},
    {"t", U"ŢţŤťŦŧȚțṪṫṬṭṮṯṰṱẗ"},
    {"th", U"Þþ"},
    {"u", U"ÙÚÛÜùúûüŨũŪūŬŭŮůŰűŲųƯưǓǔǕǖǗǘǙǚǛǜȔȕȖȗṲṳṴṵṶṷṸṹṺṻỤụỦủỨứỪừỬửỮữỰự"},
    {"v", U"ṼṽṾṿ"},
    {"w", U"ŴŵẀẁẂẃẄẅẆẇẈẉẘ"},
    {"x", U"ẊẋẌẍ"},
    {"y", U"ÝýÿŶŷŸȲȳẎẏẙỲỳỴỵỶỷỸỹ"},
    {"z", U"ŹźŻżŽžẐẑẒẓẔẕ"},
};

const std::map<char32_t, const char*>& list_latin() {
  static const std::map<char32_t, const char*> letters = [] {
    std::map<char32_t, const char*> result;
    for (const Row& row : latin)
      for (const char32_t variant : row.variants) result.emplace(variant, row.letter);
    return result;
  }();
  return letters;
}

// Takes a code point from the front of valid UTF-8; a byte that begins none is taken as Latin-1.
char32_t take_code_point(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  char32_t code = first;
  std::size_t length = 1;
  if (more > 0 && more < text.size()) {
    code = first & (0x3fu >> more);
    for (; length <= more; ++length) code = code << 6 | (byte(length) & 0x3fu);
  }
  text.remove_prefix(length);
  return code;
}

void append(std::string& text, char32_t code) {
  const auto add = [&](char32_t byte) {
    text += static_cast<char>(static_cast<unsigned char>(byte));
  };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xc0 | code >> 6);
  } else {
    if (code < 0x10000) {
      add(0xe0 | code >> 12);
    } else {
      add(0xf0 | (code >> 18 & 7));
      add(0x80 | (code >> 12 & 0x3f));
    }
    add(0x80 | (code >> 6 & 0x3f));
  }
  add(0x80 | (code & 0x3f));
}

bool is_between(char32_t code, char32_t first, char32_t last) {
  return code >= first && code <= last;
}

char32_t to_small(char32_t code) {
  if (is_between(code, U'A', U'Z') || is_between(code, U'Α', U'Ω') || is_between(code, U'А', U'Я'))
    return code + 0x20;
  return is_between(code, U'Ѐ', U'Џ') ? code + 0x50 : code;
}

// Returns whether a mark stands between words, or is left out of them as a blank.
bool is_gap(char32_t code) {
  constexpr std::u32string_view marks = U"-.,;:/()'\"`´_\u00a0";
  return code <= U' ' || marks.find(code) != marks.npos || is_between(code, 0x2000, 0x206f) ||
         code == 0x3000;
}

bool is_combining(char32_t code) {
  return is_between(code, 0x300, 0x36f);
}

}  // namespace

std::string fold_name(std::string_view name) {
  std::string folded;
  bool gap = false;
  while (!name.empty()) {
    const char32_t code = take_code_point(name);
    if (is_gap(code)) gap = true;
    if (is_gap(code) || is_combining(code)) continue;
    if (gap && !folded.empty()) folded += ' ';
    gap = false;
    const auto letter = list_latin().find(code);
    if (letter != list_latin().end())
      folded += letter->second;
    else
      append(folded, to_small(code));
  }
  return folded;
}

}  // namespace nightcity::scene
