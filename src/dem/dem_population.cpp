#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"
#include "dem/dem_state.h"
#include "dem/rigid_motion.h"

namespace sluice {

namespace {
/// Keeps v[i] at new_index[i] where that is not -1.
template <class T>
void keep(std::vector<T>& v, const std::vector<int>& new_index, std::size_t kept) {
  if (v.empty()) return;
  for (std::size_t i = 0; i < new_index.size(); ++i)
    if (const int to = new_index[i]; to >= 0 && static_cast<std::size_t>(to) != i)
      v[static_cast<std::size_t>(to)] = std::move(v[i]);
  v.resize(kept);
}
constexpr std::size_t room_tail =
    64;  // rocks added since the grid for has_room was made, looked at one by one

[[noreturn]] void refuse(std::string problem, const char* reason, const char* suggestion) {
  InputProblem p;
  p.key = "rock";
  p.problem = std::move(problem);
  p.reason = reason;
  p.suggestion = suggestion;
  throw InputError(std::move(p));
}
}  // namespace

double DemSystem::mass_of(int shape, int material, double size) const {
  const DemScene& scene = implementation_->scene;
  return scene.materials.all[static_cast<std::size_t>(material)].density *
         scene.shapes[static_cast<std::size_t>(shape)].volume * size * size * size;
}

std::uint64_t DemSystem::add(const NewRock& rock) {
  Implementation& s = *implementation_;
  const bool known = rock.shape >= 0 && static_cast<std::size_t>(rock.shape) < s.scene.shapes.size() &&
                     rock.material >= 0 &&
                     static_cast<std::size_t>(rock.material) < s.scene.materials.all.size();
  if (!known) refuse("has a shape or material that is not in the scene", "both are indices", "add it there");
  const double mass = mass_of(rock.shape, rock.material, rock.size);
  if (!(rock.size > 0) || !(mass > 0) || !std::isfinite(mass))
    refuse(fmt::format("has size {} m and mass {} kg", rock.size, mass), "both must be positive",
           "check its size and its material's density");
  if (!rock.x.allFinite() || !rock.v.allFinite() || !rock.w.allFinite() || !(rock.q.norm() > 0))
    refuse("has a place or velocity that is no number", "it could not move", "check what feeds it");

  Rocks& r = s.rocks;
  r.id.push_back(s.next_id++);
  r.x.push_back(s.periodic ? s.scene.domain.wrapped(rock.x) : rock.x);
  r.v.push_back(rock.v);
  r.w.push_back(rock.w);
  r.q.push_back(rock.q.normalized());
  r.shape.push_back(rock.shape);
  r.material.push_back(rock.material);
  r.source.push_back(rock.source);
  r.size.push_back(rock.size);
  r.mass.push_back(mass);
  r.radius.push_back(s.scene.shapes[static_cast<std::size_t>(rock.shape)].bounding_radius * rock.size);
  r.birth.push_back(s.now);
  r.wet_dose.push_back(0);
  s.momentum_added += mass * rock.v;
  r.wetted.push_back(0);
  const std::size_t i = s.count() - 1;
  if (!s.only_spheres) {
    s.angular.push_back(angular_momentum(r.q[i], r.w[i], s.inertia(i)));
    s.per_inertia.push_back(s.inertia(i).cwiseInverse());
  }
  s.push.emplace_back();
  if (!s.fluid_force.empty()) {
    s.fluid_force.emplace_back(Vec3::Zero());
    s.fluid_torque.emplace_back(Vec3::Zero());
  }
  s.listed_at.push_back(r.x[i]);
  s.margin.push_back(0);
  if (s.has_walls) s.near_walls.emplace_back();
  for (MovingWalls& part : s.moving) part.near.emplace_back();
  s.energy_added += s.kinetic_energy(i);
  s.list_valid = false;
  return r.id.back();
}

bool DemSystem::Implementation::has_room(const Vec3& x, double radius, bool check_walls) {
  if (!room_valid || count() - room_count > std::max(room_tail, room_count / 8)) {
    room_reach.resize(count());
    for (std::size_t i = 0; i < count(); ++i) room_reach[i] = rocks.radius[i] + 2 * margin[i];
    if (count() > 0) room.build(rocks.x, room_reach, scene.domain);
    room_count = count();
    room_valid = true;
  }
  const auto meets = [&](std::size_t j) {
    Vec3 d = rocks.x[j] - x;
    if (periodic) d = scene.domain.nearest_image(d);
    const double reach = radius + rocks.radius[j];
    return d.squaredNorm() < reach * reach;
  };
  bool met = false;
  if (room_count > 0) room.near(x, radius, room.deepest(), [&](std::size_t j) { met = met || meets(j); });
  for (std::size_t j = room_count; j < count() && !met; ++j) met = meets(j);
  if (met || !check_walls) return !met;
  const auto is_clear_of = [&](const WallsAndSurface& part, const Vec3& at) {
    std::vector<int> near;
    part.walls.query().triangles_in(Box{at, at}.grown(radius), near);
    return std::none_of(near.begin(), near.end(), [&](int t) {
      const WallTriangle& triangle = part.surface.triangle(t);
      if (triangle.patch < 0) return false;
      const auto& c = triangle.corner;
      return (closest_on_triangle(at, c[0], c[1], c[2]) - at).squaredNorm() < radius * radius;
    });
  };
  return (!has_walls || is_clear_of({still, surface}, x)) &&
         std::all_of(moving.begin(), moving.end(), [&](const MovingWalls& part) {
           return is_clear_of({part.walls, part.surface}, part.now.to_rest(x));
         });
}

bool DemSystem::has_room(const Vec3& x, double radius, bool check_walls) const {
  return implementation_->has_room(x, radius, check_walls);
}

void DemSystem::Implementation::compact(const std::vector<int>& new_index, std::size_t kept) {
  const std::size_t listed = pairs.rock_count();
  const auto kept_listed = static_cast<std::size_t>(
      std::count_if(new_index.begin(), new_index.begin() + static_cast<std::ptrdiff_t>(listed),
                    [](int to) { return to >= 0; }));
  pairs.renumber(std::span(new_index).first(listed), kept_listed);
  keep(rocks.id, new_index, kept);
  keep(rocks.x, new_index, kept);
  keep(rocks.v, new_index, kept);
  keep(rocks.w, new_index, kept);
  keep(rocks.q, new_index, kept);
  keep(rocks.shape, new_index, kept);
  keep(rocks.material, new_index, kept);
  keep(rocks.source, new_index, kept);
  keep(rocks.size, new_index, kept);
  keep(rocks.mass, new_index, kept);
  keep(rocks.radius, new_index, kept);
  keep(rocks.birth, new_index, kept);
  keep(rocks.wet_dose, new_index, kept);
  keep(rocks.wetted, new_index, kept);
  keep(angular, new_index, kept);
  keep(per_inertia, new_index, kept);
  keep(push, new_index, kept);
  keep(fluid_force, new_index, kept);
  keep(fluid_torque, new_index, kept);
  keep(listed_at, new_index, kept);
  keep(margin, new_index, kept);
  keep(near_walls, new_index, kept);
  for (MovingWalls& part : moving) keep(part.near, new_index, kept);
  room_valid = false;
}

std::vector<RemovedRock> DemSystem::remove(std::span<const std::size_t> indices) {
  Implementation& s = *implementation_;
  std::vector<RemovedRock> removed;
  if (indices.empty()) return removed;
  std::vector<int> new_index(s.count());
  std::size_t next = 0, kept = 0;
  for (std::size_t i = 0; i < s.count(); ++i) {
    if (next < indices.size() && indices[next] == i) {
      const Rocks& r = s.rocks;
      removed.push_back(
          {r.id[i], r.x[i], r.v[i], r.size[i], r.mass[i], r.birth[i], r.wet_dose[i], r.source[i]});
      s.momentum_removed += r.mass[i] * r.v[i];
      s.energy_removed += s.kinetic_energy(i);
      new_index[i] = -1;
      ++next;
    } else {
      new_index[i] = static_cast<int>(kept++);
    }
  }
  if (next != indices.size())
    throw std::logic_error("DemSystem::remove: indices must ascend and lie below the number of rocks");
  s.compact(new_index, kept);
  return removed;
}

std::vector<RemovedRock> DemSystem::remove_outside() {
  const Implementation& s = *implementation_;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < s.count(); ++i)
    if (s.scene.domain.outside(s.rocks.x[i])) indices.push_back(i);
  return remove(indices);
}

void DemSystem::add_wet_dose(std::span<const double> wetted_fraction, double dt) {
  Rocks& r = implementation_->rocks;
  if (wetted_fraction.size() != r.count())
    throw std::logic_error("DemSystem::add_wet_dose: one wetted fraction per rock");
  for (std::size_t i = 0; i < r.count(); ++i) {
    r.wetted[i] = wetted_fraction[i];
    r.wet_dose[i] += wetted_fraction[i] * dt;
  }
}

Vec3 DemSystem::momentum_added() const {
  return implementation_->momentum_added;
}
Vec3 DemSystem::momentum_removed() const {
  return implementation_->momentum_removed;
}

void DemSystem::set_fluid_force(std::span<const Vec3> force, std::span<const Vec3> torque) {
  Implementation& s = *implementation_;
  if (force.size() != s.count() || torque.size() != s.count())
    throw std::logic_error("DemSystem::set_fluid_force: one force and one torque per rock");
  s.fluid_force.assign(force.begin(), force.end());
  s.fluid_torque.assign(torque.begin(), torque.end());
}

}  // namespace sluice
