#include "tools/names/lines_apart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

namespace nightcity::names {
namespace {

using Square = std::pair<std::int64_t, std::int64_t>;

Square find_square(const glm::dvec2& p) {
  return {static_cast<std::int64_t>(std::floor(p.x / apart_m)),
          static_cast<std::int64_t>(std::floor(p.y / apart_m))};
}

// Sets of lines that belong together (union, find).
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t line) {
    while (parent_[line] != line) line = parent_[line] = parent_[parent_[line]];
    return line;
  }
  // The first of the lines stands for the set.
  void unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<std::vector<Line>> group_lines_apart(const std::vector<Line>& lines) {
  Groups groups(lines.size());
  std::map<Square, std::size_t> owners;
  const auto enter = [&](const glm::dvec2& p, std::size_t line) {
    const auto [column, row] = find_square(p);
    if (const auto [known, is_new] = owners.try_emplace({column, row}, line); !is_new)
      return groups.unite(known->second, line);
    for (std::int64_t c = column - 1; c <= column + 1; ++c)
      for (std::int64_t r = row - 1; r <= row + 1; ++r)
        if (const auto near = owners.find({c, r}); near != owners.end())
          groups.unite(near->second, line);
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    enter(lines[i].front(), i);
    for (std::size_t k = 1; k < lines[i].size(); ++k) {
      const glm::dvec2 &a = lines[i][k - 1], &b = lines[i][k];
      const double steps = std::ceil(glm::distance(a, b) / (apart_m / 2));
      for (double step = 1; step <= steps; ++step) enter(glm::mix(a, b, step / steps), i);
    }
  }
  std::map<std::size_t, std::vector<Line>> by_group;
  for (std::size_t i = 0; i < lines.size(); ++i) by_group[groups.find(i)].push_back(lines[i]);
  std::vector<std::vector<Line>> result;
  for (auto& [first, group] : by_group) result.push_back(std::move(group));
  return result;
}

}  // namespace nightcity::names
