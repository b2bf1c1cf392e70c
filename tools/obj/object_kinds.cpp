#include "tools/obj/object_kinds.h"

#include <array>
#include <string>
#include <utility>

namespace nightcity::obj {
namespace {

using city::ObjectType;
using std::string_view;

constexpr std::array<std::pair<string_view, ObjectType>, 32> words{{
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

ObjectType find_object_type(string_view name) {
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
  return ObjectType::building;
}

}  // namespace nightcity::obj
