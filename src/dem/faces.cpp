#include "dem/faces.h"

namespace sluice {

std::array<Quat, face_copies> face_turns() {
  const std::array<Vec3, face_copies> about{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  std::array<Quat, face_copies> turns;
  for (std::size_t c = 0; c < face_copies; ++c)
    turns[c] = Quat(Eigen::AngleAxisd(face_turn * about[c].norm(), about[c].normalized()));
  return turns;
}

}  // namespace sluice
