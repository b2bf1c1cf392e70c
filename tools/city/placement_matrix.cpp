#include "tools/city/placement_matrix.h"

#include <glm/matrix.hpp>

namespace nightcity::city {

std::optional<glm::dmat4> make_placement(const std::array<double, 16>& rows) {
  glm::dmat4 matrix;  // glm's are columns
  for (int i = 0; i < 16; ++i) matrix[i % 4][i / 4] = rows[static_cast<std::size_t>(i)];
  if (matrix[3][3] == 0) matrix[3][3] = 1;
  const auto has_last_row = [](const glm::dmat4& m) {
    return m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0;
  };
  if (has_last_row(matrix)) matrix = glm::transpose(matrix);
  if (has_last_row(matrix) || !(matrix[3][3] > 0)) return {};
  return matrix / matrix[3][3];
}

}  // namespace nightcity::city
