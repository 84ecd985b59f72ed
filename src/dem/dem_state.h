#pragma once
/// What a DemSystem holds, and the passes of its step.
///
/// A step is kick - drift - contacts - kick (velocity Verlet; the dashpots see the half-step velocity):
///
///   drift     half kick with the forces of the last step, move, turn         one loop over rocks
///   contacts  each rock's pairs with higher indices, and its walls            one loop over rocks
///   finish    sum of each rock's forces in list order, half kick              one loop over rocks
///
/// Loops run in chunks of a fixed length; a chunk owns its tallies, which are added in chunk order
/// when asked for. So nothing depends on the number of threads, and nothing is summed in a step.

#include <memory>

#include "dem/dem_system.h"
#include "dem/pair_list.h"
#include "dem/wall_contact.h"

namespace sluice {

/// What the contact loop reads of a rock: two cache lines.
struct alignas(64) Body {
  Vec3 x;         ///< [m]
  double radius;  ///< bounding [m]
  Vec3 v;         ///< at the half step [m/s]
  double mass;    ///< [kg]
  Vec3 w;         ///< at the half step [rad/s]
  double size;    ///< [m]
  int material;
  int shape;
};

/// A contact's force on the first rock and torque on the second; the first rock's torque is added at once.
struct PairForce {
  Vec3 force;   ///< [N]
  Vec3 torque;  ///< [N m]
};

/// Triangles near a rock, and its contacts with them.
struct RockWalls {
  Vec3 at = Vec3::Constant(std::numeric_limits<double>::infinity());  ///< where the triangles were looked up
  std::vector<int> triangles;
  std::vector<WallTouch> touches;
};

/// Tallies and scratch of one chunk of rocks.
struct DemChunk {
  // since the run began
  double lost_normal = 0, lost_friction = 0, wall_work = 0, fluid_work = 0;  ///< [J]
  double mass_seconds = 0;                                                   ///< integral of the mass [kg s]
  Vec3 fluid_impulse = Vec3::Zero();                                         ///< [N s]
  double overlap_most = 0;                                                   ///< of the radius
  std::vector<WallLoad> loads;                                               ///< one per wall
  // of the last step
  std::vector<WallLoad> rates;  ///< force [N] and torque [N m] on each wall, in the place of the impulses
  double elastic = 0;           ///< [J]
  std::uint64_t contacts = 0;
  double moved2 = 0;             ///< square of the largest distance from where the pairs were listed [m2]
  std::vector<double> overlaps;  ///< of the radius, when sampled
  WallScratch scratch;
};

/// Where two bodies touch and how easily they yield there.
struct Touch {
  Vec3 normal;
  Vec3 point;             ///< [m]
  double overlap;         ///< [m]
  double mass_effective;  ///< along the normal, lever arms included [kg]
};

struct StepTime {
  double t, dt;  ///< [s]
  bool sampled;  ///< overlaps are kept
};

struct DemSystem::Implementation {
  Implementation(const DemConfig& config, DemScene scene, const Walls& walls);

  static constexpr std::size_t chunk_length = 256;

  DemConfig config;
  DemScene scene;
  const Walls& walls;
  WallSurface surface;
  DemStepLimits limits;
  std::vector<ContactLaw> laws;         ///< by pair of materials
  std::vector<std::uint8_t> is_sphere;  ///< by shape
  bool only_spheres = true, has_rolling = false, has_walls = false, periodic = false;
  double skin = 0;  ///< of the pair list [m]

  Rocks rocks;
  std::vector<Vec3> angular;        ///< angular momentum of rocks [kg m2/s]; empty where all are spheres
  std::vector<Vec3> force, torque;  ///< of contacts, last step
  std::vector<Vec3> fluid_force, fluid_torque;  ///< empty until set
  std::vector<Vec3> listed_at;                  ///< where each rock was when the pairs were listed [m]
  std::vector<RockWalls> near_walls;            ///< empty without walls
  PairList pairs;
  bool list_valid = true;
  std::uint64_t next_id = 0, steps = 0;
  double now = 0;                                                       ///< end of the last step [s]
  Vec3 momentum_added = Vec3::Zero(), momentum_removed = Vec3::Zero();  ///< since start [N s]

  std::vector<DemChunk> chunks;
  Histogram overlap_histogram;
  double overlap_sum = 0, overlap_count = 0;
  mutable std::vector<WallLoad> load_sums;

  // rebuilt each step
  std::vector<Body> bodies;
  std::vector<PairForce> pair_force;
  std::vector<Vec3> own_force, own_torque;

  // for has_room
  CellGrid room;
  std::vector<double> room_reach;
  std::size_t room_count = 0;
  bool room_valid = false;

  std::size_t count() const { return rocks.count(); }
  const RockShape& shape_of(std::size_t i) const {
    return scene.shapes[static_cast<std::size_t>(rocks.shape[i])];
  }
  Vec3 inertia(std::size_t i) const {
    return shape_of(i).inertia * (rocks.mass[i] * rocks.size[i] * rocks.size[i]);
  }
  const ContactLaw& law(int a, int b) const {
    return laws[static_cast<std::size_t>(a) * scene.materials.all.size() + static_cast<std::size_t>(b)];
  }
  Superquadric superquadric(std::size_t i, const Vec3& x) const {
    const RockShape& shape = shape_of(i);
    return {x, rocks.q[i], shape.semi_axes * rocks.size[i], shape.blockiness};
  }

  void step(double t, double dt);
  void prepare_chunks(double dt);
  void drift(const StepTime& time);
  void list_pairs();
  void contacts(const StepTime& time);
  void finish(const StepTime& time);
  void give_half_to_walls(double dt);
  void kick(std::size_t i, double seconds);

  void pairs_of(DemChunk& chunk, std::size_t i, const StepTime& time);
  void touch_pair(DemChunk& chunk, std::size_t i, std::size_t p, const Touch& touch, const Vec3& image,
                  const StepTime& time);
  void end_pair(DemChunk& chunk, std::size_t i, std::size_t p);
  bool superquadrics_touch(std::size_t i, std::size_t p, const Vec3& separation, Touch& touch);
  double yield(std::size_t i, const Vec3& arm, const Vec3& n) const;
  void walls_of(DemChunk& chunk, std::size_t i, const StepTime& time);
  void touch_wall(DemChunk& chunk, std::size_t i, WallTouch& touch, const StepTime& time);
  void note_overlap(DemChunk& chunk, std::size_t i, double ratio, const StepTime& time) const;

  void compact(const std::vector<int>& new_index, std::size_t kept);
  bool has_room(const Vec3& x, double radius, bool check_walls);
  std::size_t memory_bytes() const;
  void exchange(StateArchive& archive);
  void exchange_rocks(StateArchive& archive);
  void exchange_tallies(StateArchive& archive);
  void exchange_walls(StateArchive& archive);
};

}  // namespace sluice
