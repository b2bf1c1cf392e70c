#include "tools/osm/colour_words.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <unordered_map>

#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

const std::unordered_map<std::string_view, std::uint32_t>& names() {
  static const std::unordered_map<std::string_view, std::uint32_t> table{
      {"aliceblue", 0xF0F8FF},
      {"antiquewhite", 0xFAEBD7},
      {"aqua", 0x00FFFF},
      {"aquamarine", 0x7FFFD4},
      {"azure", 0xF0FFFF},
      {"beige", 0xF5F5DC},
      {"bisque", 0xFFE4C4},
      {"black", 0x000000},
      {"blanchedalmond", 0xFFEBCD},
      {"blue", 0x0000FF},
      {"blueviolet", 0x8A2BE2},
      {"brown", 0xA52A2A},
      {"burlywood", 0xDEB887},
      {"cadetblue", 0x5F9EA0},
      {"chartreuse", 0x7FFF00},
      {"chocolate", 0xD2691E},
      {"coral", 0xFF7F50},
      {"cornflowerblue", 0x6495ED},
      {"cornsilk", 0xFFF8DC},
      {"crimson", 0xDC143C},
      {"cyan", 0x00FFFF},
      {"darkblue", 0x00008B},
      {"darkcyan", 0x008B8B},
      {"darkgoldenrod", 0xB8860B},
      {"darkgray", 0xA9A9A9},
      {"darkgreen", 0x006400},
      {"darkgrey", 0xA9A9A9},
      {"darkkhaki", 0xBDB76B},
      {"darkmagenta", 0x8B008B},
      {"darkolivegreen", 0x556B2F},
      {"darkorange", 0xFF8C00},
      {"darkorchid", 0x9932CC},
      {"darkred", 0x8B0000},
      {"darksalmon", 0xE9967A},
      {"darkseagreen", 0x8FBC8F},
      {"darkslateblue", 0x483D8B},
      {"darkslategray", 0x2F4F4F},
      {"darkslategrey", 0x2F4F4F},
      {"darkturquoise", 0x00CED1},
      {"darkviolet", 0x9400D3},
      {"deeppink", 0xFF1493},
      {"deepskyblue", 0x00BFFF},
      {"dimgray", 0x696969},
      {"dimgrey", 0x696969},
      {"dodgerblue", 0x1E90FF},
      {"firebrick", 0xB22222},
      {"floralwhite", 0xFFFAF0},
      {"forestgreen", 0x228B22},
      {"fuchsia", 0xFF00FF},
      {"gainsboro", 0xDCDCDC},
      {"ghostwhite", 0xF8F8FF},
      {"gold", 0xFFD700},
      {"goldenrod", 0xDAA520},
      {"gray", 0x808080},
      {"green", 0x008000},
      {"greenyellow", 0xADFF2F},
      {"grey", 0x808080},
      {"honeydew", 0xF0FFF0},
      {"hotpink", 0xFF69B4},
      {"indianred", 0xCD5C5C},
      {"indigo", 0x4B0082},
      {"ivory", 0xFFFFF0},
      {"khaki", 0xF0E68C},
      {"lavender", 0xE6E6FA},
      {"lavenderblush", 0xFFF0F5},
      {"lawngreen", 0x7CFC00},
      {"lemonchiffon", 0xFFFACD},
      {"lightblue", 0xADD8E6},
      {"lightcoral", 0xF08080},
      {"lightcyan", 0xE0FFFF},
      {"lightgoldenrodyellow", 0xFAFAD2},
      {"lightgray", 0xD3D3D3},
      {"lightgreen", 0x90EE90},
      {"lightgrey", 0xD3D3D3},
      {"lightpink", 0xFFB6C1},
      {"lightsalmon", 0xFFA07A},
      {"lightseagreen", 0x20B2AA},
      {"lightskyblue", 0x87CEFA},
      {"lightslategray", 0x778899},
      {"lightslategrey", 0x778899},
      {"lightsteelblue", 0xB0C4DE},
      {"lightyellow", 0xFFFFE0},
      {"lime", 0x00FF00},
      {"limegreen", 0x32CD32},
      {"linen", 0xFAF0E6},
      {"magenta", 0xFF00FF},
      {"maroon", 0x800000},
      {"mediumaquamarine", 0x66CDAA},
      {"mediumblue", 0x0000CD},
      {"mediumorchid", 0xBA55D3},
      {"mediumpurple", 0x9370DB},
      {"mediumseagreen", 0x3CB371},
      {"mediumslateblue", 0x7B68EE},
      {"mediumspringgreen", 0x00FA9A},
      {"mediumturquoise", 0x48D1CC},
      {"mediumvioletred", 0xC71585},
      {"midnightblue", 0x191970},
      {"mintcream", 0xF5FFFA},
      {"mistyrose", 0xFFE4E1},
      {"moccasin", 0xFFE4B5},
      {"navajowhite", 0xFFDEAD},
      {"navy", 0x000080},
      {"oldlace", 0xFDF5E6},
      {"olive", 0x808000},
      {"olivedrab", 0x6B8E23},
      {"orange", 0xFFA500},
      {"orangered", 0xFF4500},
      {"orchid", 0xDA70D6},
      {"palegoldenrod", 0xEEE8AA},
      {"palegreen", 0x98FB98},
      {"paleturquoise", 0xAFEEEE},
      {"palevioletred", 0xDB7093},
      {"papayawhip", 0xFFEFD5},
      {"peachpuff", 0xFFDAB9},
      {"peru", 0xCD853F},
      {"pink", 0xFFC0CB},
      {"plum", 0xDDA0DD},
      {"powderblue", 0xB0E0E6},
      {"purple", 0x800080},
      {"rebeccapurple", 0x663399},
      {"red", 0xFF0000},
      {"rosybrown", 0xBC8F8F},
      {"royalblue", 0x4169E1},
      {"saddlebrown", 0x8B4513},
      {"salmon", 0xFA8072},
      {"sandybrown", 0xF4A460},
      {"seagreen", 0x2E8B57},
      {"seashell", 0xFFF5EE},
      {"sienna", 0xA0522D},
      {"silver", 0xC0C0C0},
      {"skyblue", 0x87CEEB},
      {"slateblue", 0x6A5ACD},
      {"slategray", 0x708090},
      {"slategrey", 0x708090},
      {"snow", 0xFFFAFA},
      {"springgreen", 0x00FF7F},
      {"steelblue", 0x4682B4},
      {"tan", 0xD2B48C},
      {"teal", 0x008080},
      {"thistle", 0xD8BFD8},
      {"tomato", 0xFF6347},
      {"turquoise", 0x40E0D0},
      {"violet", 0xEE82EE},
      {"wheat", 0xF5DEB3},
      {"white", 0xFFFFFF},
      {"whitesmoke", 0xF5F5F5},
      {"yellow", 0xFFFF00},
      {"yellowgreen", 0x9ACD32},
      {"cream", 0xFFFDD0},
      {"offwhite", 0xFAF9F6},
      {"ochre", 0xCC7722},
      {"lightbrown", 0xC4A484},
      {"darkbrown", 0x5C4033},
      {"anthracite", 0x383E42}};
  return table;
}

// German mappers write colours in their language; a light or dark one is that of CSS.
const std::unordered_map<std::string_view, std::string_view>& german_names() {
  static const std::unordered_map<std::string_view, std::string_view> table{
      {"wei\xc3\x9f", "white"},
      {"weiss", "white"},
      {"schwarz", "black"},
      {"rot", "red"},
      {"hellrot", "lightcoral"},
      {"dunkelrot", "darkred"},
      {"gelb", "yellow"},
      {"hellgelb", "lightyellow"},
      {"gr\xc3\xbcn", "green"},
      {"gruen", "green"},
      {"hellgr\xc3\xbcn", "lightgreen"},
      {"dunkelgr\xc3\xbcn", "darkgreen"},
      {"blau", "blue"},
      {"hellblau", "lightblue"},
      {"dunkelblau", "darkblue"},
      {"grau", "gray"},
      {"hellgrau", "lightgray"},
      {"dunkelgrau", "dimgray"},
      {"braun", "brown"},
      {"hellbraun", "lightbrown"},
      {"dunkelbraun", "darkbrown"},
      {"rosa", "pink"},
      {"t\xc3\xbcrkis", "turquoise"},
      {"lila", "purple"},
      {"violett", "violet"},
      {"anthrazit", "anthracite"},
      {"creme", "cream"},
      {"ocker", "ochre"},
      {"silber", "silver"}};
  return table;
}

// Colours of RAL Classic that walls and roofs have, as usual tables give them in sRGB.
const std::unordered_map<std::string_view, std::uint32_t>& ral_colours() {
  static const std::unordered_map<std::string_view, std::uint32_t> table{
      {"1001", 0xD0B084}, {"1013", 0xE3D9C6}, {"1014", 0xDDC49A}, {"1015", 0xE6D2B5},
      {"3000", 0xA72920}, {"3009", 0x6D342D}, {"3011", 0x792423}, {"5010", 0x004F7C},
      {"6005", 0x114232}, {"7001", 0x8C969D}, {"7015", 0x51565C}, {"7016", 0x383E42},
      {"7035", 0xC5C7C4}, {"7040", 0x989EA1}, {"8004", 0x8D4931}, {"8012", 0x66332B},
      {"8017", 0x442F29}, {"9001", 0xE9E0D2}, {"9002", 0xD7D5CB}, {"9005", 0x0E0E10},
      {"9006", 0xA1A1A0}, {"9007", 0x878581}, {"9010", 0xF1ECE1}, {"9016", 0xF1F0EA}};
  return table;
}

std::optional<std::uint32_t> parse_hex(std::string_view digits) {
  const bool is_short = digits.size() == 3 || digits.size() == 4;
  if (!is_short && digits.size() != 6 && digits.size() != 8) return std::nullopt;
  std::uint32_t value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  if (digits.size() == 4) value >>= 4;
  if (digits.size() == 8) value >>= 8;
  if (!is_short) return value;
  const std::uint32_t r = value >> 8 & 15u, g = value >> 4 & 15u, b = value & 15u;
  return (r * 0x11) << 16 | (g * 0x11) << 8 | b * 0x11;
}

std::optional<std::uint32_t> parse_rgb(std::string_view text) {
  text.remove_prefix(text.starts_with("rgba(") ? 5 : 4);
  std::uint32_t value = 0;
  for (int channel = 0; channel < 3; ++channel) {
    while (text.starts_with('_') || text.starts_with(',')) text.remove_prefix(1);
    unsigned part = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), part);
    if (error != std::errc() || part > 255) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    value = value << 8 | part;
  }
  return text.ends_with(')') ? std::optional(value) : std::nullopt;
}

std::optional<std::uint32_t> parse_one(std::string_view text) {
  std::string word = normalise_tag(text);
  if (word.starts_with("rgb(") || word.starts_with("rgba(")) return parse_rgb(word);
  std::erase(word, '_');
  if (word.starts_with('#')) return parse_hex(std::string_view(word).substr(1));
  if (word.starts_with("ral")) {
    const auto ral = ral_colours().find(std::string_view(word).substr(3));
    return ral == ral_colours().end() ? std::nullopt : std::optional(ral->second);
  }
  if (const auto german = german_names().find(word); german != german_names().end())
    word = german->second;
  if (const auto known = names().find(word); known != names().end()) return known->second;
  return word.size() == 6 ? parse_hex(word) : std::nullopt;
}

}  // namespace

std::optional<std::uint32_t> parse_colour(std::string_view text) {
  std::string list(text);
  // "red|white", "red, white"; a formula such as "rgb(1, 2, 3)" has commas of its own.
  if (list.find('(') == std::string::npos)
    for (char& c : list)
      if (c == '|' || c == ',' || c == '/') c = ';';
  for (const std::string_view part : split_list(list))
    if (const auto colour = parse_one(part)) return colour;
  return std::nullopt;
}

}  // namespace nightcity::osm
