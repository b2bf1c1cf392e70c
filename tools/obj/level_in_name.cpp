#include "tools/obj/level_in_name.h"

#include <cstddef>
#include <map>
#include <utility>

#include "formats/to_lower.h"
#include "tools/city/better_level.h"

namespace nightcity::obj {
namespace {

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_digit_up_to(char c, char last) {
  return c >= '0' && c <= last;
}

char char_at(std::string_view text, std::size_t i) {
  return i < text.size() ? text[i] : '\0';
}

struct Mark {
  std::size_t end = 0;  // behind it; 0: there is none
  int level = 0;
};

// Reads "lod2", "lod-2", "lod22" or "lod2.2" at `at`. Levels within a level go from 0 to 3
// (Biljecki et al. 2016). A second number behind another character may count tiles: it is no level.
Mark read_mark(std::string_view name, std::size_t at) {
  if (!name.substr(at).starts_with("lod") || (at > 0 && is_letter(name[at - 1]))) return {};
  std::size_t i = at + 3;
  if (std::string_view(" _-.").find(char_at(name, i)) != std::string_view::npos) ++i;
  if (!is_digit_up_to(char_at(name, i), '4')) return {};
  Mark mark{i + 1, 10 * (name[i] - '0')};
  const std::size_t second = mark.end + (char_at(name, mark.end) == '.');
  if (is_digit_up_to(char_at(name, second), '3') && !is_digit_up_to(char_at(name, second + 1), '9'))
    mark = {second + 1, mark.level + (name[second] - '0')};
  return is_digit_up_to(char_at(name, mark.end), '9') ? Mark{} : mark;
}

}  // namespace

std::optional<LevelInName> find_level_in_name(std::string_view name) {
  const std::string lower = to_lower(name);
  if (!lower.ends_with(".obj") && !lower.ends_with(".obj.gz")) return {};
  std::optional<LevelInName> found;
  std::string rest;
  for (std::size_t i = 0; i < lower.size();) {
    if (const Mark mark = read_mark(lower, i); mark.end > 0) {
      found = {mark.level, {}};
      i = mark.end;
      rest += '\0';
    } else {
      rest += name[i++];
    }
  }
  if (found) found->rest = std::move(rest);
  return found;
}

std::vector<bool> find_best_levels(const std::vector<std::string>& names, int max_lod) {
  struct Best {
    int level = 0;
    std::size_t file = 0;
  };
  std::vector<bool> read(names.size(), true);
  std::map<std::string, Best> best;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto named = find_level_in_name(names[i]);
    if (!named) continue;
    const auto [at, is_new] = best.try_emplace(named->rest, Best{named->level, i});
    if (is_new) continue;
    const bool better = city::is_better_level(named->level, at->second.level, 10 * max_lod + 9);
    read[better ? at->second.file : i] = false;
    if (better) at->second = {named->level, i};
  }
  return read;
}

}  // namespace nightcity::obj
