#include "tools/georeference/srs_names.h"

#include "formats/to_lower.h"

#include <algorithm>
#include <array>

namespace nightcity::georeference {
namespace {

struct Alias {
  std::string_view name;  // lower case
  std::string_view definition;
};

// Names that PROJ refuses or misunderstands. The German ones are those of the AdV register
// (urn:adv:crs:...) without the height part behind '*': only the horizontal CRS matters here,
// heights stay as in the file.
constexpr std::array aliases{
    Alias{"crs:84", "OGC:CRS84"},
    Alias{"crs84", "OGC:CRS84"},
    Alias{"ch1903", "EPSG:21781"},
    Alias{"ch1903_lv03", "EPSG:21781"},
    Alias{"ch1903+", "EPSG:2056"},
    Alias{"ch1903+_lv95", "EPSG:2056"},
    Alias{"etrs89_utm31", "EPSG:25831"},
    Alias{"etrs89_utm32", "EPSG:25832"},
    Alias{"etrs89_utm33", "EPSG:25833"},
    Alias{"etrs89_utm31_ze-n", "EPSG:5649"},
    Alias{"etrs89_utm32_ze-n", "EPSG:4647"},
    Alias{"etrs89_utm33_ze-n", "EPSG:5650"},
    Alias{"etrs89_lat-lon", "EPSG:4258"},
    Alias{"de_dhdn_3gk2", "EPSG:31466"},
    Alias{"de_dhdn_3gk3", "EPSG:31467"},
    Alias{"de_dhdn_3gk4", "EPSG:31468"},
    Alias{"de_dhdn_3gk5", "EPSG:31469"},
    Alias{"de_42-83_3gk3", "EPSG:2397"},
    Alias{"de_42-83_3gk4", "EPSG:2398"},
    Alias{"de_42-83_3gk5", "EPSG:2399"},
    Alias{"de_pd-83_3gk3", "EPSG:3396"},
    Alias{"de_pd-83_3gk4", "EPSG:3397"},
    Alias{"de_rd-83_3gk4", "EPSG:3398"},
    Alias{"de_rd-83_3gk5", "EPSG:3399"},
};

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// The longest alias that `name` equals or begins with before a regional suffix
// ("de_dhdn_3gk4_by120").
const Alias* find_alias(std::string_view name) {
  const Alias* best = nullptr;
  for (const Alias& alias : aliases) {
    if (!name.starts_with(alias.name)) continue;
    const bool whole = name.size() == alias.name.size();
    const bool suffix = !whole && alias.name.starts_with("de_") && name[alias.name.size()] == '_';
    if ((whole || suffix) && (!best || alias.name.size() > best->name.size())) best = &alias;
  }
  return best;
}

// The first EPSG code in the name: "crs:EPSG:6.12:25833" -> 25833 (the version is not the code),
// "EPSG::5514" -> 5514, "epsg.xml#28992" -> 28992, "/EPSG/0/6697" -> 6697.
std::string first_epsg_code(std::string_view name) {
  const std::string text = to_lower(name);
  const auto at = text.find("epsg");
  if (at == std::string::npos) return {};
  std::string code;
  for (std::size_t i = at + 4; i < text.size(); ++i) {
    const char c = text[i];
    if (c >= '0' && c <= '9') {
      std::size_t end = i;
      while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
      const bool version = end < text.size() && text[end] == '.';
      if (end - i >= 4 && end - i <= 6 && !version) return text.substr(i, end - i);
      i = end - 1;
    } else if (c == ',' || c == '+' || c == '&') {
      break;  // the next part of a compound is the vertical one
    }
  }
  return code;
}

// Returns whether each part of a compound URN ("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837")
// names authority, version and code.
bool has_whole_parts(std::string_view urn) {
  for (auto comma = urn.find(','); comma != std::string_view::npos; comma = urn.find(',')) {
    urn.remove_prefix(comma + 1);
    const std::string_view part = urn.substr(0, urn.find(','));
    if (std::count(part.begin(), part.end(), ':') != 3 || part.ends_with(':')) return false;
  }
  return true;
}

}  // namespace

std::vector<std::string> list_crs_definitions(std::string_view srs_name) {
  const std::string_view name = trim(srs_name);
  std::vector<std::string> definitions;
  if (name.empty()) return definitions;
  // PROJJSON says all itself: codes in it may be those of a part.
  if (name.starts_with('{')) return {std::string(name)};
  std::string key = to_lower(name);
  if (constexpr std::string_view adv = "urn:adv:crs:"; key.starts_with(adv))
    key.erase(0, adv.size());
  if (const auto star = key.find('*'); star != std::string::npos) key.erase(star);
  // The code alone, as some tables have it.
  constexpr std::size_t least_digits = 4, most_digits = 6;
  if (key.size() >= least_digits && key.size() <= most_digits &&
      key.find_first_not_of("0123456789") == std::string::npos)
    return list_crs_definitions("EPSG:" + key);
  // To PROJ such a text is an operation unless it says that it is a CRS.
  if ((key.starts_with("+proj=") || key.starts_with("proj=")) &&
      key.find("type=crs") == std::string::npos)
    return {std::string(name) + " +type=crs"};
  const Alias* alias = find_alias(key);
  if (alias) definitions.emplace_back(alias->definition);
  if (!alias) definitions.emplace_back(name);
  if (const std::string code = first_epsg_code(name); !code.empty()) {
    const std::string plain = "EPSG:" + code;
    if (std::find(definitions.begin(), definitions.end(), plain) == definitions.end())
      definitions.push_back(plain);
  }
  // Some files in ETRS89 / UTM with the zone number before the easting (Brandenburg, Mecklenburg)
  // declare the plain zone. Only the check against the area of use can see that.
  constexpr std::array zoned{Alias{"25831", "EPSG:5649"}, Alias{"25832", "EPSG:4647"},
                             Alias{"25833", "EPSG:5650"}};
  const std::vector<std::string> so_far = definitions;
  for (const Alias& zone : zoned) {
    for (const std::string& definition : so_far) {
      if (definition.find(zone.name) == std::string::npos) continue;
      definitions.emplace_back(zone.definition);
      break;
    }
  }
  return definitions;
}

AxisPromise find_axis_promise(std::string_view srs_name) {
  const std::string name = to_lower(trim(srs_name));
  if (name.find("opengis.net/def/crs") != std::string::npos) return AxisPromise::fixed;
  if (!name.starts_with("urn:ogc:def:crs") && !name.starts_with("urn:x-ogc:def:crs"))
    return AxisPromise::east_north;
  return has_whole_parts(name) ? AxisPromise::fixed : AxisPromise::register_order;
}

}  // namespace nightcity::georeference
