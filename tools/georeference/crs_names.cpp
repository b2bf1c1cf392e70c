#include "tools/georeference/crs_names.h"

#include <array>
#include <string>

#include "formats/to_lower.h"

namespace nightcity::georeference {
namespace {

std::string keep_letters_and_digits(std::string_view text) {
  std::string kept;
  for (const char c : to_lower(text))
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80)
      kept += c;
  return kept;
}

// Returns whether a text may be a name: codes, URNs, addresses, WKT, JSON and PROJ strings are
// none.
bool may_be_name(std::string_view text) {
  if (text.find_first_of("[{=") != text.npos) return false;
  const std::size_t colon = text.find(':');
  return colon == text.npos || text.substr(0, colon).find(' ') != text.npos;
}

// PROJ knows further names: "ETRS_1989_UTM_Zone_32N" is one of Esri's, and "NZTM" a part of one.
bool is_known_name(PJ_CONTEXT* context, const std::string& name) {
  constexpr std::array types{PJ_TYPE_PROJECTED_CRS, PJ_TYPE_GEOGRAPHIC_2D_CRS,
                             PJ_TYPE_GEOGRAPHIC_3D_CRS, PJ_TYPE_COMPOUND_CRS};
  const auto count = [&](bool by_part, std::size_t most) {
    PJ_OBJ_LIST* const found = proj_create_from_name(context, nullptr, name.c_str(), types.data(),
                                                     types.size(), by_part, most, nullptr);
    const int size = found ? proj_list_get_count(found) : 0;
    proj_list_destroy(found);
    return size;
  };
  constexpr std::size_t least_letters = 4;
  return count(false, 1) > 0 || (name.size() >= least_letters && count(true, 2) == 1);
}

}  // namespace

bool is_another_name(PJ_CONTEXT* context, const PJ* crs, std::string_view definition) {
  if (!may_be_name(definition)) return false;
  const char* const said = proj_get_name(crs);
  const std::string_view name = said ? said : "";
  const std::string wanted = keep_letters_and_digits(definition);
  const std::size_t slash = name.rfind('/');
  const std::string_view last = slash == name.npos ? name : name.substr(slash + 1);
  if (wanted.empty()) return true;
  return wanted != keep_letters_and_digits(name) && wanted != keep_letters_and_digits(last) &&
         !is_known_name(context, std::string(definition));
}

}  // namespace nightcity::georeference
