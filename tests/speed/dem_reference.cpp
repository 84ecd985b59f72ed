#include "speed/dem_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/find_by_id.h"
#include "dem/faces.h"
#include "speed/dem_scenes.h"

namespace sluice::speed {

namespace {
constexpr double most_by_descent = 4;  // blockiness
constexpr std::size_t first_wall = 0xffff0000u;

/// Restitution of x'' + 2 zeta x' + x = 0 from x = 0, x' = 1 until the force is zero (zeta < 1).
double rebound(double zeta) {
  const double w = std::sqrt(1 - zeta * zeta);
  const auto x = [&](double t) { return std::exp(-zeta * t) * std::sin(w * t) / w; };
  const auto speed = [&](double t) {
    return std::exp(-zeta * t) * (std::cos(w * t) - zeta / w * std::sin(w * t));
  };
  double low = 0, high = std::numbers::pi / w;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.5 * (low + high);
    (x(t) + 2 * zeta * speed(t) > 0 ? low : high) = t;
  }
  return -speed(low);
}

double damping_of(double restitution) {
  double low = 0, high = 1 - 1e-9;
  for (int i = 0; i < 100; ++i) {
    const double zeta = 0.5 * (low + high);
    (rebound(zeta) > restitution ? low : high) = zeta;
  }
  return low;
}

/// Support function of |x/a|^m + ... = 1 with its gradient (the support point) and Hessian.
struct Support {
  double height;
  Vec3 point;
  Mat3 hessian;
};
Support support(const Vec3& a, double m, const Vec3& n) {
  const double q = m / (m - 1);
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += std::pow(a[k] * std::fabs(n[k]), q);
  Support s;
  s.height = std::pow(sum, 1 / q);
  Vec3 slope;
  for (int k = 0; k < 3; ++k) {
    const double size = std::max(std::fabs(n[k]), 1e-12);
    s.point[k] =
        std::copysign(std::pow(a[k], q) * std::pow(std::fabs(n[k]), q - 1) * std::pow(s.height, 1 - q), n[k]);
    slope[k] = std::pow(a[k], q) * std::pow(size, q - 2) * std::pow(s.height, 1 - q);
  }
  s.hessian = (q - 1) * (Mat3(slope.asDiagonal()) - s.point * s.point.transpose() / s.height);
  return s;
}

bool above_polygon(const PlainWall& wall, const Vec3& x) {
  for (std::size_t c = 0; c < wall.corners.size(); ++c) {
    const Vec3& from = wall.corners[c];
    const Vec3& to = wall.corners[(c + 1) % wall.corners.size()];
    if ((to - from).cross(x - from).dot(wall.normal) < 0) return false;
  }
  return true;
}
}  // namespace

Pairs overlapping_spheres(const std::vector<Vec3>& x, const std::vector<double>& radius,
                          const Domain& domain) {
  // Each sphere stands in all cells that its box touches.
  Box box = domain.box;
  const double reach = *std::max_element(radius.begin(), radius.end());
  for (int k = 0; k < 3; ++k)
    if (!domain.periodic(k)) {
      box.lo[k] = box.hi[k] = x[0][k];
      for (const Vec3& place : x) {
        box.lo[k] = std::min(box.lo[k], place[k] - reach);
        box.hi[k] = std::max(box.hi[k], place[k] + reach);
      }
    }
  const double wanted = 4 * *std::min_element(radius.begin(), radius.end());
  const Vec3i cells = (box.size() / wanted).array().floor().cast<int>().max(1);
  const Vec3 step = box.size().cwiseQuotient(cells.cast<double>());
  std::vector<std::vector<int>> held(static_cast<std::size_t>(cells.cast<long>().prod()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    Vec3i low, count;
    for (int k = 0; k < 3; ++k) {
      low[k] = static_cast<int>(std::floor((x[i][k] - radius[i] - box.lo[k]) / step[k]));
      const int high = static_cast<int>(std::floor((x[i][k] + radius[i] - box.lo[k]) / step[k]));
      count[k] = std::min(high - low[k] + 1, cells[k]);
    }
    for (int k = 0; k < count.prod(); ++k) {
      Vec3i at = low + Vec3i(k % count.x(), k / count.x() % count.y(), k / (count.x() * count.y()));
      for (int d = 0; d < 3; ++d) at[d] = (at[d] % cells[d] + cells[d]) % cells[d];
      held[static_cast<std::size_t>(at.x() + cells.x() * (at.y() + cells.y() * at.z()))].push_back(
          static_cast<int>(i));
    }
  }
  Pairs pairs;
  for (const auto& cell : held)
    for (std::size_t a = 0; a < cell.size(); ++a)
      for (std::size_t b = a + 1; b < cell.size(); ++b) {
        const auto i = static_cast<std::size_t>(cell[a]), j = static_cast<std::size_t>(cell[b]);
        const double both = radius[i] + radius[j];
        if (domain.nearest_image(x[j] - x[i]).squaredNorm() < both * both)
          pairs.push_back({cell[a], cell[b]});
      }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

PlainRocks::PlainRocks(const DemSystem& dem, double restitution, double friction,
                       std::vector<PlainWall> walls)
    : zeta_(damping_of(restitution)), friction_(friction), walls_(std::move(walls)) {
  const Rocks& r = dem.rocks();
  ids_ = r.id;
  before_ = {r.x, r.v, r.w, r.q};
  force_.assign(r.count(), Vec3::Zero());
  torque_ = force_;
}

/// I w or I^-1 w of a rock in space.
Vec3 PlainRocks::turn_inertia(const DemSystem& dem, std::size_t rock, const Vec3& w, bool inverse) const {
  const Mat3 turn = dem.rocks().q[rock].toRotationMatrix();
  const Vec3 inertia = dem.inertia(rock);
  const Vec3 body = turn.transpose() * w;
  return turn * (inverse ? Vec3(body.cwiseQuotient(inertia)) : Vec3(body.cwiseProduct(inertia)));
}

bool PlainRocks::common_normal(const Superquadric& a, const Superquadric& b, Contact& contact) {
  const Mat3 turn_a = a.q.toRotationMatrix(), turn_b = b.q.toRotationMatrix();
  const Vec3 d = b.x - a.x;
  // The overlap along n is h_A(n) + h_B(-n) - n d: the direction of the least one is the normal.
  struct Value {
    double overlap;
    Vec3 on_a, on_b;  // from the centre of A
    Mat3 hessian;
  };
  const auto at = [&](const Vec3& n) {
    const Support s = support(a.semi_axes, a.m, turn_a.transpose() * n);
    const Support t = support(b.semi_axes, b.m, turn_b.transpose() * -n);
    return Value{s.height + t.height - n.dot(d), turn_a * s.point, d + turn_b * t.point,
                 turn_a * s.hessian * turn_a.transpose() + turn_b * t.hessian * turn_b.transpose()};
  };
  const double least = std::min(a.semi_axes.minCoeff(), b.semi_axes.minCoeff());
  if (a.m > most_by_descent) {
    // Flat faces: the direction says too little about the point, so both are the library's, cold, to
    // rounding. Its overlap must be that of the support functions, and no direction near by may have a
    // smaller one.
    PairMemory cold;
    ContactGeometry found;
    superquadric_gap(a, b, cold, found);
    const double overlap = at(found.normal).overlap;
    bool proved = std::fabs(overlap - found.overlap) < 1e-8 * least;
    for (int k = 0; k < 8 && proved; ++k) {
      const auto [e1, e2] = tangent_frame(found.normal);
      const double angle = 0.25 * k * std::numbers::pi;
      const Vec3 aside = (found.normal + 1e-5 * (std::cos(angle) * e1 + std::sin(angle) * e2)).normalized();
      proved = at(aside).overlap > overlap - 1e-9 * least;
    }
    unproved_ += !proved;
    contact.normal = found.normal;
    contact.overlap = found.overlap;
    contact.arm_first = found.point;
    contact.arm_second = found.point - d;
    return found.overlap > 0;
  }
  Vec3 n = d.normalized();
  Value value = at(n);
  double stiffer = 0;
  for (int iteration = 0; iteration < 300; ++iteration) {
    if (value.overlap < 0) return false;  // n separates them
    const Vec3 slope = value.on_a - value.on_b;
    const auto [e1, e2] = tangent_frame(n);
    const Eigen::Vector2d g(slope.dot(e1), slope.dot(e2));
    if (g.norm() < 1e-11 * least) break;
    Eigen::Matrix2d h;
    h << e1.dot(value.hessian * e1), e1.dot(value.hessian * e2), e2.dot(value.hessian * e1),
        e2.dot(value.hessian * e2);
    h.diagonal().array() += stiffer - value.overlap;
    const Eigen::Vector2d move = -h.ldlt().solve(g);
    const Vec3 tried = (n + move.x() * e1 + move.y() * e2).normalized();
    const Value next = at(tried);
    if (move.dot(g) < 0 && move.norm() < 0.5 && next.overlap <= value.overlap) {
      n = tried;
      value = next;
      stiffer *= stiffer > 1e-6 * least ? 0.2 : 0;
    } else {
      stiffer = std::max(4 * stiffer, 1e-3 * least);
    }
  }
  contact.normal = n;
  contact.overlap = value.overlap;
  contact.arm_first = 0.5 * (value.on_a + value.on_b);
  contact.arm_second = contact.arm_first - d;
  return value.overlap > 0;
}

void PlainRocks::find_contacts(const DemSystem& dem) {
  const Rocks& r = dem.rocks();
  contacts_.clear();
  for (const auto& [i, j] : overlapping_spheres(r.x, r.radius, dem.scene().domain)) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const RockShape& shape_a = dem.shapes()[static_cast<std::size_t>(r.shape[a])];
    const RockShape& shape_b = dem.shapes()[static_cast<std::size_t>(r.shape[b])];
    const Vec3 d = dem.scene().domain.nearest_image(r.x[b] - r.x[a]);
    Contact c;
    c.key = {a, b, 0};
    c.first = i;
    c.second = j;
    c.size = 2 * r.size[a] * r.size[b] / (r.size[a] + r.size[b]);
    if (shape_a.is_sphere()) {
      c.normal = d.normalized();
      c.overlap = 0.5 * (r.size[a] + r.size[b]) - d.norm();
      c.arm_first = (0.5 * r.size[a] - 0.5 * c.overlap) * c.normal;
      c.arm_second = c.arm_first - d;
      contacts_.push_back(c);
      continue;
    }
    const Superquadric one{Vec3::Zero(), r.q[a], dem.semi_axes(a), shape_a.blockiness};
    const Superquadric other{d, r.q[b], dem.semi_axes(b), shape_b.blockiness};
    if (!has_faces(one.m) || !has_faces(other.m)) {
      if (common_normal(one, other, c)) contacts_.push_back(c);
      continue;
    }
    const bool copy_first = r.size[a] != r.size[b] ? r.size[a] < r.size[b] : r.id[a] < r.id[b];
    const FaceCopies copies = copy_first ? make_face_copies(shape_a.semi_axes, one.m)
                                         : make_face_copies(shape_b.semi_axes, other.m);
    c.share = face_share;
    for (std::size_t k = 0; k < face_copies; ++k) {
      Superquadric copied = copy_first ? one : other;
      copied.q = copied.q * copies.turns[k];
      copied.semi_axes = copies.semi_axes * (copy_first ? r.size[a] : r.size[b]);
      c.key[2] = k;
      if (common_normal(copy_first ? copied : one, copy_first ? other : copied, c)) contacts_.push_back(c);
    }
  }
}

void PlainRocks::find_wall_contacts(const DemSystem& dem) {
  const Rocks& r = dem.rocks();
  for (std::size_t i = 0; i < r.count(); ++i)
    for (std::size_t k = 0; k < walls_.size(); ++k) {
      const PlainWall& wall = walls_[k];
      const double height = (r.x[i] - wall.corners[0]).dot(wall.normal);
      const double overlap = 0.5 * r.size[i] - height;
      if (!(overlap > 0) || height < 0 || !above_polygon(wall, r.x[i])) continue;
      Contact c;
      c.key = {i, first_wall + k, 0};
      c.first = static_cast<int>(i);
      c.second = -1;
      c.normal = -wall.normal;
      c.overlap = overlap;
      c.arm_first = (height + 0.5 * overlap) * c.normal;
      c.size = r.size[i];
      contacts_.push_back(c);
    }
}

double PlainRocks::mobility(const DemSystem& dem, int rock, const Vec3& arm, const Vec3& n) const {
  if (rock < 0) return 0;
  const auto i = static_cast<std::size_t>(rock);
  const Vec3 lever = arm.cross(n);
  return 1 / dem.rocks().mass[i] + lever.dot(turn_inertia(dem, i, lever, true));
}

void PlainRocks::add_force(const DemSystem& dem, const Contact& c, double dt) {
  const auto i = static_cast<std::size_t>(c.first), j = static_cast<std::size_t>(std::max(0, c.second));
  const bool wall = c.second < 0;
  const double k_n = stiffness_per_size * c.size, k_t = tangential_ratio * k_n;
  const double mass =
      1 / (mobility(dem, c.first, c.arm_first, c.normal) + mobility(dem, c.second, c.arm_second, c.normal));
  const double c_n = 2 * zeta_ * std::sqrt(k_n * mass), c_t = 2 * zeta_ * std::sqrt(k_t * mass);
  Vec3 velocity = v_half_[i] + w_half_[i].cross(c.arm_first);
  if (!wall) velocity -= v_half_[j] + w_half_[j].cross(c.arm_second);
  const double closing = velocity.dot(c.normal);
  const Vec3 sliding = velocity - closing * c.normal;
  // A dashpot sampled half a step late, and one that stands for no more than the time since the bodies met.
  const double normal = std::max(0.0, k_n * c.overlap + closing / (1 / c_n + 0.25 * dt / mass));
  double pushed = normal;
  if (c.overlap < closing * dt) {
    const double weighted = (0.5 + c.overlap / (closing * dt)) * c_n;
    pushed = k_n * c.overlap + closing / (1 / weighted + 0.5 * dt / mass);
  }

  // The spring turns into the plane of contact, then stretches; both together obey Coulomb.
  const auto known = std::lower_bound(memory_.begin(), memory_.end(), c.key,
                                      [](const Memory& m, const Key& key) { return m.key < key; });
  Vec3 spring = known != memory_.end() && known->key == c.key ? known->spring : Vec3(Vec3::Zero());
  const double length = spring.norm();
  spring -= spring.dot(c.normal) * c.normal;
  if (length > 0) spring *= length / spring.norm();
  spring += dt * sliding;
  Vec3 tangential = k_t * spring + c_t * sliding;
  if (tangential.norm() > friction_ * normal) {
    tangential *= friction_ * normal / tangential.norm();
    spring = normal > 0 ? Vec3((tangential - c_t * sliding) / k_t) : Vec3(Vec3::Zero());
  }
  new_memory_.push_back({c.key, spring});

  if (normal > 0) tangential *= pushed / normal;
  const Vec3 force = c.share * (-pushed * c.normal - tangential);
  force_[i] += force;
  torque_[i] += c.arm_first.cross(force);
  if (wall) return;
  force_[j] -= force;
  torque_[j] -= c.arm_second.cross(force);
}

/// The system may have sorted its rocks.
void PlainRocks::take_order_of(const Rocks& rocks) {
  if (rocks.id == ids_) return;
  FindById old_places(ids_);
  const State state = before_;
  const std::vector<Vec3> force = force_, torque = torque_;
  std::vector<std::size_t> new_place(ids_.size());
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    const std::size_t from = old_places.find(rocks.id[i]).value();
    new_place[from] = i;
    before_.x[i] = state.x[from];
    before_.v[i] = state.v[from];
    before_.w[i] = state.w[from];
    before_.q[i] = state.q[from];
    force_[i] = force[from];
    torque_[i] = torque[from];
  }
  for (Memory& memory : memory_) {
    auto& [first, second, copy] = memory.key;
    first = new_place[first];
    if (second >= first_wall) continue;
    second = new_place[second];
    if (first < second) continue;
    std::swap(first, second);
    memory.spring = -memory.spring;  // it is now seen from the other rock
  }
  std::sort(memory_.begin(), memory_.end(), [](const Memory& a, const Memory& b) { return a.key < b.key; });
  ids_ = rocks.id;
}

Departure PlainRocks::follow(const DemSystem& dem, double dt, double tolerance) {
  const Rocks& r = dem.rocks();
  const Vec3& gravity = dem.scene().gravity;
  const std::size_t n = r.count();
  take_order_of(r);
  const auto angular = [&](std::size_t i, const Quat& q, const Vec3& w) -> Vec3 {
    return q * Vec3((q.conjugate() * w).cwiseProduct(dem.inertia(i)));
  };
  Departure result;

  // Half a kick and the move.
  v_half_.resize(n);
  w_half_.resize(n);
  std::vector<Vec3> l_half(n);
  double farthest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    v_half_[i] = before_.v[i] + 0.5 * dt * (force_[i] / r.mass[i] + gravity);
    l_half[i] = angular(i, before_.q[i], before_.w[i]) + 0.5 * dt * torque_[i];
    w_half_[i] = turn_inertia(dem, i, l_half[i], true);
    farthest = std::max(farthest, dt * v_half_[i].norm());
    const Vec3 moved = dem.scene().domain.nearest_image(r.x[i] - before_.x[i]);
    result.position = std::max(result.position, (moved - dt * v_half_[i]).norm());
  }
  result.position /= farthest;

  // Forces where the rocks now are, and the other half.
  unproved_ = 0;
  find_contacts(dem);
  find_wall_contacts(dem);
  std::sort(contacts_.begin(), contacts_.end(),
            [](const Contact& a, const Contact& b) { return a.key < b.key; });
  force_.assign(n, Vec3::Zero());
  torque_.assign(n, Vec3::Zero());
  new_memory_.clear();
  for (const Contact& contact : contacts_) add_force(dem, contact, dt);
  memory_.swap(new_memory_);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const auto& [first, second, copy] = contacts_[k].key;
    if (k > 0 && contacts_[k - 1].key[0] == first && contacts_[k - 1].key[1] == second) continue;
    ++result.contacts;
    result.wall_contacts += contacts_[k].second < 0;
  }
  result.unproved = unproved_;

  double kick = 0, twist = 0;
  for (std::size_t i = 0; i < n; ++i) {
    kick += 0.5 * dt * force_[i].norm() / r.mass[i] / static_cast<double>(n);
    twist += 0.5 * dt * torque_[i].norm() / static_cast<double>(n);
  }
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (left_out_ && left_out_(r.x[i])) continue;
    const Vec3 v = v_half_[i] + 0.5 * dt * (force_[i] / r.mass[i] + gravity);
    const Vec3 l = l_half[i] + 0.5 * dt * torque_[i];
    const double off = (r.v[i] - v).norm() / kick;
    const double off_turn = (angular(i, r.q[i], r.w[i]) - l).norm() / twist;
    result.velocity = std::max(result.velocity, off);
    result.turning = std::max(result.turning, off_turn);
    wrong += !(off < tolerance && off_turn < tolerance);
  }
  result.wrong_share = static_cast<double>(wrong) / static_cast<double>(n);
  before_ = {r.x, r.v, r.w, r.q};
  return result;
}

}  // namespace sluice::speed
