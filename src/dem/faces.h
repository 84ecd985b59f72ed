#pragma once
/// Faces of blocky rocks, so that they rest and keep energy.
///
/// The face of a superquadric with a large m is flat: where it lies on another flat face, one contact point
/// jumps from corner to corner, the rock never rests, and it gains energy. So a blocky rock meets flat things
/// as four copies of itself, each with a quarter of the strength (force, damping, friction, rolling) and a
/// history of its own. The copies are turned by small body-fixed angles, about each axis by face_turn times
/// the ratio of the two axes across, the shorter over the longer; so each touches near another corner of a
/// face, at the same part of its width whatever the aspect. They are thinner by what the turn lowers the
/// corners: the faces stay where they are, edges and corners lie some percent of the semi-axis further in.
///
///        copy 0      copy 1                 together
///     \_________   _________/            \___________/
///      `--.__          __.--'             `-._____.-'      four points, one for each corner
///
/// Each copy is a rigid part of the rock: the sum of the four has a potential and obeys the third law as one
/// contact does, and in no direction is it stiffer than one contact, so the step limits hold. Whether a rock
/// has copies depends on its shape alone and never changes.
///
/// - Against walls, every blocky rock: faces, edges and vertices alike, so that a copy that slides off a
///   face hands over to the edge.
/// - Between two rocks, where both are blocky; a rounder one touches a face in one well-defined point. The
///   smaller is copied (the elder, if alike): a copy turned about a far centre would stand off the face.
///
/// It costs four solves a pair. Damping is that of each corner's own effective mass, so a rock that falls
/// flat on a face rebounds higher than `restitution`. Mass and inertia are the shape's own.

#include <array>
#include <cstddef>

#include "base/vec.h"

namespace sluice {

/// Blockiness above which a rock has faces; up to there one point keeps energy within the bound for spheres.
constexpr double roundest_face = 6;
constexpr std::size_t face_copies = 4;
constexpr double face_share = 1.0 / face_copies;
/// Turn of a cube's copies about each body axis [rad]. Measured on throwaway code: such a rock creeps 5e-8 of
/// its size on an incline and rests on planes and rocks.
constexpr double face_turn = 0.03;

constexpr bool has_faces(double blockiness) {
  return blockiness > roundest_face;
}

struct FaceCopies {
  std::array<Quat, face_copies> turns;  ///< frame of each copy to that of the rock
  Vec3 semi_axes = Vec3::Zero();        ///< of all copies, in the unit of the shape's
};

/// @pre has_faces(m)
FaceCopies make_face_copies(const Vec3& semi_axes, double m);

}  // namespace sluice
