#pragma once
/// Where a rock touches the walls: one contact for each place where the distance from the rock to the
/// whole surface has a minimum of its own, so a fan of coplanar triangles, a shared edge or a seam
/// between parts gives exactly one, and two walls of a corner give two.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "dem/superquadric_contact.h"
#include "dem/wall_parts.h"
#include "dem/wall_surface.h"

namespace sluice {

/// A contact with a wall, and what it remembers.
struct WallTouch {
  int patch = -1;
  int wall = -1;
  int feature = -1;              ///< -1 face, else 2 e for edge e, 2 v + 1 for vertex v
  int side = 1;                  ///< of the patch's normal on which the rock's centre was at first touch
  Vec3 normal = Vec3::Zero();    ///< from rock to wall, unit
  Vec3 point = Vec3::Zero();     ///< [m]
  double overlap = 0;            ///< [m]
  Vec3 spring = Vec3::Zero();    ///< tangential stretch [m]
  Vec3 turned = Vec3::Zero();    ///< rolling history [rad]
  Vec3 start = Vec3::Zero();     ///< warm start of a superquadric on an edge or vertex, body frame [m]
  int copy = 0;                  ///< of a blocky rock, which of its copies touches (faces.h)
  std::vector<Vec3> rings = {};  ///< shear_rings with partial_slip, else none: stretch of each [m]
};

struct WallHit {
  Vec3 nearest;
  double distance2;
  int triangle;
};

/// What a search needs and may throw away; one per thread.
struct WallScratch {
  std::vector<WallTouch> found;
  std::vector<WallTouch> of_copies;  ///< found for the copies before, of a blocky rock
  std::vector<WallHit> hits;
  std::vector<std::uint8_t> taken;
};

/// Contacts of a sphere with the triangles given (ascending), into `scratch.found`, history left blank.
/// @param before  its contacts of the last step: they fix the side on which it is
/// @return gap to the nearest of them at least, not above 0 where it touches [m]
double find_sphere_contacts(const WallSurface& surface, std::span<const int> triangles, const Vec3& x,
                            double radius, std::span<const WallTouch> before, WallScratch& scratch);

/// The same for a superquadric, or one of the copies that it is; a contact with a face that is not known must
/// begin with an overlap below `deepest` [m], or it is the far part of a rock that reaches around an edge.
/// @param parts  near it; begin_search was called
void find_superquadric_contacts(const WallSurface& surface, WallParts& parts, std::size_t copy,
                                const Superquadric& body, double bounding_radius, double deepest,
                                std::span<const WallTouch> before, WallScratch& scratch);

/// Gives the found contacts the history of the old ones: of the same place first, then of the same
/// patch, then of the same wall where the normals agree. `lost(old)` is called for each that ended.
template <class Lost>
void carry_history(std::vector<WallTouch>& before, WallScratch& scratch, const Lost& lost);

template <class Lost>
void carry_history(std::vector<WallTouch>& before, WallScratch& scratch, const Lost& lost) {
  constexpr double same_direction = 0.7;  // normals closer than 45 degrees
  std::vector<WallTouch>& found = scratch.found;
  scratch.taken.assign(before.size() + found.size(), 0);
  for (int round = 0; round < 3; ++round)
    for (std::size_t f = 0; f < found.size(); ++f) {
      if (scratch.taken[before.size() + f]) continue;
      for (std::size_t b = 0; b < before.size(); ++b) {
        const WallTouch& old = before[b];
        if (scratch.taken[b] || old.wall != found[f].wall || old.copy != found[f].copy) continue;
        if (round < 2 && old.patch != found[f].patch) continue;
        if (round < 1 && old.feature != found[f].feature) continue;
        if (round > 0 && old.normal.dot(found[f].normal) < same_direction) continue;
        found[f].spring = old.spring;
        found[f].turned = old.turned;
        found[f].rings = old.rings;
        scratch.taken[b] = scratch.taken[before.size() + f] = 1;
        break;
      }
    }
  for (std::size_t b = 0; b < before.size(); ++b)
    if (!scratch.taken[b]) lost(before[b]);
  before.assign(found.begin(), found.end());
}

}  // namespace sluice
