#pragma once
/// What a DemSystem holds, and the passes of its step.
///
/// A step is kick - drift - contacts - kick (velocity Verlet; for the dashpots see sampled_dashpot.h):
///
///   drift     half kick with the forces of the last step, move, turn         one loop over rocks
///   contacts  each rock's pairs with higher indices, and its walls            one loop over chunks
///   finish    what other chunks' pairs push back, half kick                   one loop over rocks
///
/// Of several steps in a row, the end of one and the drift of the next are one loop.
///
/// Loops run in chunks of a fixed length; a chunk owns its tallies, which are added in chunk order
/// when asked for. So nothing depends on the number of threads, and nothing is summed in a step.

#include <memory>

#include "base/parallel.h"
#include "dem/dem_system.h"
#include "dem/faces.h"
#include "dem/hertz_mindlin.h"
#include "dem/moving_walls.h"
#include "dem/pair_list.h"
#include "dem/superquadric_pairs.h"
#include "dem/wall_contact.h"

namespace sluice {

/// What a contact reads of a rock.
struct Body {
  Vec3 x;         ///< [m]
  double radius;  ///< bounding [m]
  Vec3 v;         ///< at the half step [m/s]
  double mass;    ///< [kg]
  Vec3 w;         ///< at the half step [rad/s]
  double size;    ///< [m]
  int material;
  int shape;
};

/// Force and torque on a rock: one cache line, eight doubles to the lanes.
struct alignas(64) Push {
  Vec3 force = Vec3::Zero();   ///< [N]
  double rock = 0;             ///< whom it is for, where it waits in a queue
  Vec3 torque = Vec3::Zero();  ///< [N m]
  double unused = 0;
};

/// What pairs read of a rock, as rows that lanes load whole: where it is ...
struct RockPlaceRow {
  Vec3 x;         ///< [m]
  double radius;  ///< bounding [m]
};
/// ... and, only where it touches, how it moves.
struct alignas(64) RockMotionRow {
  Vec3 v;       ///< at the half step [m/s]
  double mass;  ///< [kg]
  Vec3 w;       ///< at the half step [rad/s]
  double size;  ///< [m]
};

/// A listed pair of a chunk whose bounding spheres meet.
struct Candidate {
  Vec3 separation;  ///< centre of j (its nearest image) - centre of i [m]
  std::uint32_t pair, i, j;
};

/// Listed pairs of spheres of a chunk that meet, a column a quantity, in the order of the list.
struct MeetingSpheres {
  static constexpr std::size_t spare = 8;  ///< places behind the last that lanes may overwrite

  std::size_t count = 0;
  std::vector<double> x, y, z;             ///< centre of j (its nearest image) - centre of i [m]
  std::vector<double> radius_i, radius_j;  ///< [m]
  std::vector<std::uint32_t> pair, i, j;

  void make_room(std::size_t most);
  void add(const Candidate& candidate, double radius_of_i, double radius_of_j);
  /// Repeats the last in the spare places.
  void repeat_last();
  std::size_t memory_bytes() const {
    return (x.capacity() + y.capacity() + z.capacity() + radius_i.capacity() + radius_j.capacity()) *
               sizeof(double) +
           (pair.capacity() + i.capacity() + j.capacity()) * sizeof(std::uint32_t);
  }
  Candidate candidate(std::size_t k) const { return {{x[k], y[k], z[k]}, pair[k], i[k], j[k]}; }
};

/// What one chunk needs while its contacts are looked at; one a thread.
struct PairScratch {
  std::size_t begin = 0;                  ///< first rock of the chunk
  MeetingSpheres spheres;                 ///< all of these touch
  std::vector<Candidate> shaped;          ///< at least one is a superquadric
  std::vector<BodyPair> shaped_pairs;     ///< the same
  std::vector<ContactGeometry> geometry;  ///< of those
  std::vector<PairOutcome> outcome;
  std::vector<std::uint8_t> repeated;  ///< where a copy of the same pair is deeper; empty without faces
};

/// Tallies and scratch of one chunk of rocks.
struct DemChunk {
  // since the run began
  double lost_normal = 0, lost_friction = 0, wall_work = 0, fluid_work = 0;  ///< [J]
  double mass_seconds = 0;                                                   ///< integral of the mass [kg s]
  double gravity_work = 0;                                                   ///< [J]
  Vec3 fluid_impulse = Vec3::Zero();                                         ///< [N s]
  double overlap_most = 0;                                                   ///< of the radius
  std::vector<WallLoad> loads;                                               ///< one per wall
  // of the last step
  std::vector<WallLoad> rates;  ///< force [N] and torque [N m] on each wall, in the place of the impulses
  double elastic = 0;           ///< [J]
  std::uint64_t contacts = 0;
  bool moved_far = false;        ///< a rock is farther from where the pairs were listed than its margin
  std::vector<double> overlaps;  ///< of the radius, when sampled
  WallScratch scratch;
};

/// Where two bodies touch and how easily they yield there.
struct Touch {
  Vec3 normal;            ///< from the first to the second, unit
  Vec3 arm_a;             ///< from the centre of the first [m]
  double overlap;         ///< [m]
  double mass_effective;  ///< along the normal, lever arms included [kg]
};

/// Walls and what rocks meet of them.
struct WallsAndSurface {
  const Walls& walls;
  const WallSurface& surface;
};

/// Where a rock is, in the frame of the walls.
struct RockPlace {
  Vec3 x;  ///< [m]
  Quat q;
};

struct StepTime {
  double t, dt;  ///< [s]
  bool sampled;  ///< overlaps are kept
};

struct DemSystem::Implementation {
  Implementation(const DemConfig& config, DemScene scene, const Walls& walls);

  // How far a rock may go before the pairs are listed again, of its bounding radius; beside periodic faces at
  // most so far that it cannot reach another one twice.
  static constexpr double least_margin = 0.03, most_margin = 0.3;
  // Of the radius in one step: beyond it contacts would be missed.
  static constexpr double longest_move = 0.5;

  DemConfig config;
  DemScene scene;
  const Walls& walls;
  std::unique_ptr<Walls> still_part;  ///< only where walls move
  const Walls& still;                 ///< the walls that do not
  WallSurface surface;                ///< of those
  std::vector<MovingWalls> moving;
  DemStepLimits limits;
  std::vector<ContactLaw> laws;         ///< by pair of materials
  std::vector<std::uint8_t> is_sphere;  ///< by shape
  bool only_spheres = true, has_rolling = false, has_walls = false, periodic = false;
  bool has_blocky = false;         ///< some shape has faces
  std::vector<FaceCopies> copies;  ///< by shape, unset for those without faces; empty if none has
  bool plain_laws = true;          ///< every pair is linear, without adhesion

  Rocks rocks;
  std::vector<Vec3> angular;      ///< angular momentum of rocks [kg m2/s]; empty where all are spheres
  std::vector<Vec3> per_inertia;  ///< one over the principal inertia [1/(kg m2)]; empty likewise
  /// What contacts read of the rocks; of spheres among spheres the only copy that is current within steps.
  std::vector<RockPlaceRow> places;
  std::vector<RockMotionRow> motions;
  std::vector<Push> push;                       ///< of contacts, last step
  std::vector<Vec3> fluid_force, fluid_torque;  ///< empty until set
  std::vector<Vec3> listed_at;                  ///< where each rock was when the pairs were listed [m]
  std::vector<double> margin;                   ///< how far it may go from there [m]
  std::vector<RockWalls> near_walls;            ///< empty without still walls
  PairList pairs;
  bool list_valid = true;
  std::uint64_t next_id = 0, steps = 0, lists = 0;
  double now = 0;                                                       ///< end of the last step [s]
  Vec3 momentum_added = Vec3::Zero(), momentum_removed = Vec3::Zero();  ///< since start [N s]
  double energy_added = 0, energy_removed = 0;                          ///< kinetic, since start [J]

  std::vector<DemChunk> chunks;
  Histogram overlap_histogram;
  double overlap_sum = 0, overlap_count = 0;
  mutable std::vector<WallLoad> load_sums;

  // rebuilt each step
  /// One a rock, then face_copies a rock where some are blocky; empty where all are spheres.
  std::vector<TurnedShape> turned_shapes;
  std::vector<double> rim_speed;          ///< fastest that turning moves a point [m/s]; empty likewise
  std::vector<Push> reactions;            ///< by queue of the pair list
  std::vector<std::uint32_t> queued;      ///< how many wait in each
  std::vector<PairScratch> pair_scratch;  ///< by thread

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
  /// The law of all pairs of rocks, where there is but one rock material; else null.
  const ContactLaw* only_law = nullptr;
  const ContactLaw& law(int a, int b) const {
    return laws[static_cast<std::size_t>(a) * scene.materials.all.size() + static_cast<std::size_t>(b)];
  }
  Superquadric superquadric(std::size_t i, const Vec3& x) const {
    const RockShape& shape = shape_of(i);
    return {x, rocks.q[i], shape.semi_axes * rocks.size[i], shape.blockiness};
  }
  double kinetic_energy(std::size_t i) const {
    const Vec3 w_body = rocks.q[i].conjugate() * rocks.w[i];
    return 0.5 * rocks.mass[i] * rocks.v[i].squaredNorm() + 0.5 * w_body.cwiseAbs2().dot(inertia(i));
  }
  bool has_sphere_shape(int shape) const { return is_sphere[static_cast<std::size_t>(shape)] != 0; }
  bool is_blocky(std::size_t i) const { return has_blocky && has_faces(shape_of(i).blockiness); }
  const FaceCopies& copies_of(std::size_t i) const {
    return copies[static_cast<std::size_t>(rocks.shape[i])];
  }
  bool meet_as_copies(std::size_t i, std::size_t j) const { return is_blocky(i) && is_blocky(j); }
  /// Of two blocky rocks: whether the first is the one copied.
  bool is_copied(std::size_t i, std::size_t j) const {
    return rocks.size[i] != rocks.size[j] ? rocks.size[i] < rocks.size[j] : rocks.id[i] < rocks.id[j];
  }
  std::size_t copy_of(std::size_t i, std::size_t copy) const { return count() + face_copies * i + copy; }

  void steps_of(double t, double dt, int n);
  void keep_overlaps();
  void prepare_chunks(double dt);
  /// One for each chunk that the rocks are cut into now.
  void make_chunks();
  /// Calls body(chunk, begin, end) for each chunk of rocks, on the thread that had it in the loop before.
  template <class Body>
  void each_chunk(const Body& body) const {
    parallel_chunks<ChunkGoes::to_same_thread>(count(), pairs.chunk_length(), body);
  }
  /// @param goes_on  the last step still wants its end
  void drift(const StepTime& time, bool goes_on);
  /// Where the reaction on the second rock of a pair goes.
  Push& reaction_on(std::size_t j, std::size_t p) {
    const std::uint32_t q = pairs.queue[p];
    if (q == PairList::no_queue) return push[j];
    Push& waits = reactions[pairs.queue_start[q] + queued[q]++];
    waits = {};
    waits.rock = static_cast<double>(j);
    return waits;
  }
  void take_reactions(std::size_t c);
  void begin_step(DemChunk& chunk, std::size_t i, const StepTime& time);
  void turn_rocks(std::size_t begin, std::size_t end, double dt);
  void count_fluid(DemChunk& chunk, std::size_t begin, std::size_t end, double dt);
  void end_step(std::size_t i, const StepTime& time);
  Body body_of(std::size_t i) const {
    const RockPlaceRow& place = places[i];
    const RockMotionRow& motion = motions[i];
    return {place.x,  place.radius, motion.v,          motion.mass,
            motion.w, motion.size,  rocks.material[i], rocks.shape[i]};
  }
  void list_pairs(double dt);
  void turn_copies();
  void sort_in_space();
  void contacts(const StepTime& time);
  void finish(const StepTime& time);
  void give_half_to_walls(double dt);
  void take_half_of_work(double dt);
  void kick(std::size_t i, double seconds);
  void move_spheres(DemChunk& chunk, std::size_t begin, std::size_t end, const StepTime& time, bool goes_on);
  void take_from_rows(std::size_t begin, std::size_t end);
  void end_spheres(std::size_t begin, std::size_t end, const StepTime& time);
  /// Moves a rock on by a step with the velocity it has.
  void move(DemChunk& chunk, std::size_t i, Vec3& x, const RockMotionRow& motion, const StepTime& time);
  /// @param none  zero unless a velocity of the chunk is no number
  void stop_if_wild(double none, std::size_t begin, std::size_t end, const StepTime& time) const;
  [[noreturn]] void stop_fast(std::size_t i, const Vec3& v, const StepTime& time) const;
  [[noreturn]] void stop_wild(std::size_t i, const StepTime& time) const;

  void keep_rows(std::size_t begin, std::size_t end);
  void find_spheres(DemChunk& chunk, PairScratch& scratch, std::size_t end);
  void find_candidates(DemChunk& chunk, PairScratch& scratch, std::size_t end, double dt);
  bool keeps_clear(std::size_t p, std::size_t i, std::size_t j, double dt);
  void pairs_of(DemChunk& chunk, PairScratch& scratch, std::size_t end, const StepTime& time);
  BodyPair bodies_of(const Candidate& candidate) const;
  void solve_shaped(DemChunk& chunk, PairScratch& scratch);
  void find_repeated(PairScratch& scratch) const;
  Touch spheres_touch(const Candidate& candidate) const;
  Touch superquadrics_touch(const Candidate& candidate, const ContactGeometry& geometry) const;
  void touch_pair(DemChunk& chunk, const Candidate& candidate, const Touch& touch, const StepTime& time);
  double share_of(std::size_t i, std::size_t j) const { return meet_as_copies(i, j) ? face_share : 1; }
  struct LaneContacts;
  void touch_in_lanes(DemChunk& chunk, PairScratch& scratch, const StepTime& time);
  void end_pair(DemChunk& chunk, std::size_t i, std::size_t p);
  double yield(std::size_t i, const Vec3& arm, const Vec3& n) const;
  void walls_of(DemChunk& chunk, std::size_t i, const StepTime& time);
  void moving_walls_of(DemChunk& chunk, std::size_t i, const StepTime& time);
  /// Contacts of rock i, placed and turned as seen from the walls, into `near`; false if there is nothing.
  bool find_touches(DemChunk& chunk, std::size_t i, const WallsAndSurface& part, const RockPlace& place,
                    RockWalls& near);
  void find_superquadric(DemChunk& chunk, std::size_t i, const WallsAndSurface& part, const RockPlace& place,
                         RockWalls& near);
  void touch_wall(DemChunk& chunk, std::size_t i, WallTouch& touch, const SurfaceMotion& moves,
                  const StepTime& time);
  void count_touches(DemChunk& chunk, std::size_t i, const RockWalls& near, const StepTime& time) const;
  /// Stops the run where an overlap [of the radius] is beyond the limit.
  void check_overlap(DemChunk& chunk, std::size_t i, double ratio, const StepTime& time) const;
  /// A contact counts once, with the deepest of its copies.
  void count_contact(DemChunk& chunk, double ratio, const StepTime& time) const;

  void compact(const std::vector<int>& new_index, std::size_t kept);
  bool has_room(const Vec3& x, double radius, bool check_walls);
  std::size_t memory_bytes() const;
  void exchange(StateArchive& archive);
  void exchange_rocks(StateArchive& archive);
  void exchange_tallies(StateArchive& archive);
  void exchange_walls(StateArchive& archive);
  void exchange_touches(StateArchive& archive, std::vector<RockWalls>& near, std::size_t length);
};

inline void DemSystem::Implementation::move(DemChunk& chunk, std::size_t i, Vec3& x,
                                            const RockMotionRow& motion, const StepTime& time) {
  const Vec3 by = time.dt * motion.v;
  const double most = longest_move * 0.5 * motion.size;
  if (!(by.squaredNorm() <= most * most)) stop_fast(i, motion.v, time);
  x += by;
  Vec3 moved = x - listed_at[i];
  if (periodic) {
    x = scene.domain.wrapped(x);
    moved = scene.domain.nearest_image(moved);
  }
  chunk.moved_far = chunk.moved_far || moved.squaredNorm() >= margin[i] * margin[i];
  chunk.mass_seconds += motion.mass * time.dt;
  chunk.gravity_work += motion.mass * scene.gravity.dot(by);
}

}  // namespace sluice
