#include "tools/obj/object_kinds.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "formats/to_lower.h"

namespace nightcity::obj {
namespace {

using city::ObjectType;
using std::string_view;

constexpr std::array<std::pair<string_view, ObjectType>, 36> words{{
    {"building", ObjectType::building},
    {"buildings", ObjectType::building},
    {"house", ObjectType::building},
    {"houses", ObjectType::building},
    {"terrain", ObjectType::relief},
    {"dtm", ObjectType::relief},
    {"dem", ObjectType::relief},
    {"dgm", ObjectType::relief},
    {"relief", ObjectType::relief},
    {"ground", ObjectType::relief},
    {"landscape", ObjectType::relief},
    {"topography", ObjectType::relief},
    {"road", ObjectType::road},
    {"roads", ObjectType::road},
    {"street", ObjectType::road},
    {"streets", ObjectType::road},
    {"highway", ObjectType::road},
    {"highways", ObjectType::road},
    {"pavement", ObjectType::road},
    {"sidewalk", ObjectType::road},
    {"sidewalks", ObjectType::road},
    {"footpath", ObjectType::road},
    {"water", ObjectType::water},
    {"river", ObjectType::water},
    {"lake", ObjectType::water},
    {"sea", ObjectType::water},
    {"waterway", ObjectType::water},
    {"waterways", ObjectType::water},
    {"tree", ObjectType::vegetation},
    {"trees", ObjectType::vegetation},
    {"vegetation", ObjectType::vegetation},
    {"plant", ObjectType::vegetation},
    {"plants", ObjectType::vegetation},
    {"forest", ObjectType::vegetation},
    {"bush", ObjectType::vegetation},
    {"hedge", ObjectType::vegetation},
}};

}  // namespace

std::optional<ObjectType> find_named_type(string_view name) {
  std::string word;
  for (std::size_t i = 0; i <= name.size(); ++i) {
    const char c = i < name.size() ? name[i] : ' ';
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper || (c >= 'a' && c <= 'z')) {
      word += upper ? static_cast<char>(c - 'A' + 'a') : c;
      continue;
    }
    for (const auto& [known, type] : words)
      if (word == known) return type;
    word.clear();
  }
  return {};
}

ObjectType find_material_type(string_view name) {
  const std::string lower = to_lower(name);
  if (lower == "ground") return ObjectType::building;  // the floor of a house may be of it
  const auto known = std::find_if(words.begin(), words.end(),
                                  [&](const auto& word) { return word.first == lower; });
  return known == words.end() ? ObjectType::building : known->second;
}

ObjectType find_object_type(string_view name) {
  return find_named_type(name).value_or(ObjectType::building);
}

}  // namespace nightcity::obj
