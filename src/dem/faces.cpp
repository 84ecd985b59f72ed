#include "dem/faces.h"

#include <algorithm>

#include "dem/rock_shape.h"

namespace sluice {

FaceCopies make_face_copies(const Vec3& semi_axes, double m) {
  FaceCopies copies;
  Vec3 turn;
  for (int k = 0; k < 3; ++k) {
    const auto [shorter, longer] = std::minmax(semi_axes[(k + 1) % 3], semi_axes[(k + 2) % 3]);
    turn[k] = face_turn * shorter / longer;
  }
  // Vertices of a tetrahedron: each face is tilted towards its four corners.
  const std::array<Vec3, face_copies> signs{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  for (std::size_t c = 0; c < face_copies; ++c) {
    const Vec3 about = turn.cwiseProduct(signs[c]);
    copies.turns[c] = Quat(Eigen::AngleAxisd(about.norm(), about.normalized()));
  }
  // Thinned until each copy reaches as far as the rock along all three axes; by symmetry all do alike.
  constexpr int rounds = 60;  // the error falls by a factor of 10 or more each
  copies.semi_axes = semi_axes;
  const Mat3 to_copy = copies.turns[0].toRotationMatrix().transpose();
  for (int round = 0; round < rounds; ++round)
    for (int k = 0; k < 3; ++k)
      copies.semi_axes[k] *= semi_axes[k] / support_height(copies.semi_axes, m, to_copy.col(k));
  return copies;
}

}  // namespace sluice
