#include "coupling/lubrication.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/cell_grid.h"

namespace sluice {

Lubrication::Lubrication(const DemSystem& rocks, std::size_t walls, double reach, double roughness)
    : rocks_(rocks), reach_(reach), roughness_(roughness), loads_(walls) {}

// In the order of the rocks given, partners by theirs: the same whatever order the grid visits them in.
void Lubrication::find_films(const std::vector<FilmRock>& rocks) {
  const Rocks& all = rocks_.rocks();
  const Domain& domain = rocks_.scene().domain;
  std::vector<Vec3> x;
  std::vector<double> half;
  for (const FilmRock& of : rocks) {
    x.push_back(all.x[of.rock]);
    half.push_back(0.5 * (all.size[of.rock] + reach_));
  }
  CellGrid grid;
  grid.build(x, half, domain);
  films_.clear();
  std::vector<std::size_t> partners;
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const std::size_t a = rocks[i].rock;
    const double radius = 0.5 * all.size[a];
    partners.clear();
    grid.near(x[i], half[i], grid.deepest(), [&](std::size_t j) {
      if (j > i) partners.push_back(j);
    });
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    for (const std::size_t j : partners) {
      const std::size_t b = rocks[j].rock;
      const Vec3 d = domain.nearest_image(all.x[b] - all.x[a]);
      const double distance = d.norm(), other = 0.5 * all.size[b], gap = distance - radius - other;
      if (!(gap > 0 && gap < reach_)) continue;
      Film film;
      film.a = a;
      film.b = b;
      film.normal = d / distance;
      film.gap = gap;
      film.closing = (all.v[a] - all.v[b]).dot(film.normal);
      film.radius = radius * other / (radius + other);
      film.share = std::min(rocks[i].share, rocks[j].share);
      films_.push_back(film);
    }
    for (const NearWall& wall : rocks_.near_walls(a, reach_)) {
      if (!(wall.gap > 0)) continue;
      Film film;
      film.a = a;
      film.wall = wall.wall;
      film.normal = wall.normal;
      film.point = wall.point;
      film.gap = wall.gap;
      film.closing = (all.v[a] - wall.velocity).dot(film.normal);
      film.radius = radius;
      film.share = rocks[i].share;
      films_.push_back(film);
    }
  }
}

void Lubrication::add(const std::vector<FilmRock>& rocks, const FluidModel& liquid, double fines, double dt,
                      std::vector<Vec3>& force) {
  const Rocks& all = rocks_.rocks();
  find_films(rocks);
  count_.assign(all.count(), 0);
  for (const Film& film : films_) {
    ++count_[film.a];
    if (film.wall < 0) ++count_[film.b];
  }
  const FlowCurve curve = flow_curve(liquid, fines);
  std::vector<Vec3> films_force(all.count(), Vec3::Zero());
  for (const Film& film : films_) {
    const double gap = std::max(film.gap, roughness_ * film.radius);
    const double viscosity = apparent_viscosity(liquid, curve, std::abs(film.closing) / gap);
    const double rate = film.share * 6 * std::numbers::pi * viscosity * film.radius * film.radius *
                        std::max(0.0, 1 / gap - 1 / reach_);
    if (!(rate > 0)) continue;
    const double mass_a = all.mass[film.a] / count_[film.a];
    double mass = mass_a, push = (force[film.a] / all.mass[film.a]).dot(film.normal);
    if (film.wall < 0) {
      const double mass_b = all.mass[film.b] / count_[film.b];
      mass = mass_a * mass_b / (mass_a + mass_b);
      push -= (force[film.b] / all.mass[film.b]).dot(film.normal);
    } else {
      push += rocks_.scene().gravity.dot(film.normal);
    }
    // v' = push - rate / mass v over dt.
    const double fade = -std::expm1(-rate * dt / mass);
    const double end = film.closing * (1 - fade) + push * mass / rate * fade;
    const double f = mass * ((film.closing - end) / dt + push);
    films_force[film.a] -= f * film.normal;
    if (film.wall < 0) {
      films_force[film.b] += f * film.normal;
    } else {
      WallLoad& load = loads_[static_cast<std::size_t>(film.wall)];
      load.impulse += dt * f * film.normal;
      load.angular_impulse += dt * f * film.point.cross(film.normal);
    }
  }
  for (const FilmRock& of : rocks) force[of.rock] += films_force[of.rock];
}

void Lubrication::exchange(StateArchive& a) {
  std::vector<Vec3> impulse, angular;
  for (const WallLoad& load : loads_) {
    impulse.push_back(load.impulse);
    angular.push_back(load.angular_impulse);
  }
  a.values("film_impulse", impulse);
  a.values("film_angular_impulse", angular);
  for (std::size_t w = 0; w < loads_.size(); ++w) {
    loads_[w].impulse = impulse[w];
    loads_[w].angular_impulse = angular[w];
  }
}

}  // namespace sluice
