#include "geometry/wall.h"

#include <utility>

namespace sluice {

TriMesh mesh_at(const Wall& wall, double t) {
  TriMesh mesh = wall.mesh;
  if (!wall.motion) return mesh;
  const Pose pose = pose_at(*wall.motion, t);
  for (Vec3& x : mesh.vertices) x = pose.to_space(x);
  return mesh;
}

Walls::Walls(std::vector<Wall> walls) : walls_(std::move(walls)) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    mesh_.append(walls_[w].mesh);
    wall_of_.resize(mesh_.triangles.size(), static_cast<int>(w));
  }
  query_ = std::make_unique<SurfaceQuery>(mesh_);
}

Walls::Walls(Walls&&) noexcept = default;
Walls& Walls::operator=(Walls&&) noexcept = default;
Walls::~Walls() = default;

}  // namespace sluice
