// The extent of a mesh's copies, without a look at each vertex of each copy.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "formats/scene.h"
#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {

class MeshExtent {
 public:
  explicit MeshExtent(const SceneMesh& mesh);
  /// Adds the finite vertices of one copy to `bounds`. Vertices in boxes that lie within it already
  /// are passed over: thousands of copies of thousands of vertices would have no end.
  void add_copy(const glm::mat4& to_model, Bounds& bounds) const;

 private:
  struct Block {
    std::size_t begin, end;  // in points_
    glm::vec3 low, high;
  };
  Block find_block(std::size_t begin, std::size_t end) const;

  std::vector<glm::vec3> points_;  // finite ones, each once
  std::vector<Block> blocks_;
  glm::vec3 low_{0}, high_{0};  // of all
};

}  // namespace nightcity::nightbake
