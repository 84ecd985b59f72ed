#pragma once
/// A wall: triangles of one material with a surface motion, and the set of all walls of a scene.
///
/// Walls are two-sided. Normals say nothing; open sheets, plates thinner than a cell and closed solids
/// are all walls. Each phase keeps its own WallLoad per wall (base/load.h).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/surface_query.h"
#include "geometry/tri_mesh.h"
#include "geometry/wall_motion.h"

namespace sluice {

enum class BlocksPhase { both, rocks_only, water_only };

struct Wall {
  std::string name;
  TriMesh mesh;                          ///< at rest [m]
  int material = 0;                      ///< index into the scene's materials
  Vec3 surface_velocity = Vec3::Zero();  ///< of a belt: the surface moves, the shape does not [m/s]
  BlocksPhase blocks = BlocksPhase::both;
  std::optional<WallMotion> motion;  ///< of the shape; the belt's velocity is then one in the rest frame
};

/// A wall's mesh where it is at time t [s].
TriMesh mesh_at(const Wall& wall, double t);

/// All walls of a scene, as they rest, as one triangle soup with queries.
class Walls {
 public:
  Walls() : Walls(std::vector<Wall>{}) {}
  explicit Walls(std::vector<Wall> walls);
  Walls(Walls&&) noexcept;
  Walls& operator=(Walls&&) noexcept;
  ~Walls();

  const std::vector<Wall>& all() const { return walls_; }
  std::size_t size() const { return walls_.size(); }
  const TriMesh& mesh() const { return mesh_; }  ///< all triangles, walls in order
  int wall_of(int triangle) const { return wall_of_[static_cast<std::size_t>(triangle)]; }
  const SurfaceQuery& query() const { return *query_; }
  bool empty() const { return mesh_.triangles.empty(); }

  /// Velocity of the surface of a wall at a point on it [m/s].
  Vec3 surface_velocity(int wall, const Vec3& at) const {
    (void)at;
    return walls_[static_cast<std::size_t>(wall)].surface_velocity;
  }

 private:
  std::vector<Wall> walls_;
  TriMesh mesh_;
  std::vector<int> wall_of_;
  std::unique_ptr<SurfaceQuery> query_;
};

}  // namespace sluice
