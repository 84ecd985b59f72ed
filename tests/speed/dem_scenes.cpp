#include "speed/dem_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/random.h"
#include "speed/dem_reference.h"

namespace sluice::speed {

namespace {
constexpr double set_up_restitution = 0.1;
constexpr double set_up_friction = 0.15;
constexpr int most_trials = 1000000;  // places tried for a rock
constexpr int most_stages = 2000;
constexpr double last_shrink = 0.001;
constexpr double shut_in = 0.2;  // overlap over radius beyond which a small rock sits inside large ones

DemScene scene_for(const RockShape& shape, double smallest, double largest, PairProperties pair) {
  DemScene scene;
  scene.materials.all = {{"rock", density}, {"steel", 0}};
  scene.materials.pairs.assign(4, pair);
  scene.shapes = {shape};
  scene.smallest_size = smallest;
  scene.largest_size = largest;
  scene.densest = density;
  scene.gravity.setZero();
  return scene;
}

/// Spheres by octaves of their radius, each octave on a grid of its own.
class Crowd {
 public:
  Crowd(const Domain& domain, double smallest, double largest) : domain_(domain), smallest_(smallest) {
    const int octaves = static_cast<int>(std::log2(largest / smallest)) + 1;
    for (int o = 0; o < octaves; ++o) {
      Octave& octave = octaves_.emplace_back();
      octave.reach = smallest * std::ldexp(1.0, o + 1);
      octave.cells = std::max(1, static_cast<int>(domain.box.size().x() / (2 * octave.reach)));
      octave.held.resize(static_cast<std::size_t>(octave.cells * octave.cells * octave.cells));
    }
  }

  void add(const Vec3& x, double radius) {
    Octave& octave = octaves_[static_cast<std::size_t>(std::log2(radius / smallest_))];
    octave.held[slot(octave, cell(octave, x))].push_back({x, radius});
  }

  /// True if a sphere there meets any that is in the crowd.
  bool meets(const Vec3& x, double radius) const {
    for (const Octave& octave : octaves_) {
      const double step = domain_.box.size().x() / octave.cells;
      const int around = static_cast<int>(std::ceil((octave.reach + radius) / step));
      const int span = std::min(2 * around + 1, octave.cells);
      const Vec3i low = cell(octave, x) - Vec3i::Constant(around);
      for (int k = 0; k < span * span * span; ++k)
        for (const auto& [y, r] :
             octave.held[slot(octave, low + Vec3i(k % span, k / span % span, k / (span * span)))]) {
          const double reach = radius + r;
          if (domain_.nearest_image(y - x).squaredNorm() < reach * reach) return true;
        }
    }
    return false;
  }

 private:
  struct Sphere {
    Vec3 x;
    double radius;
  };
  struct Octave {
    double reach = 0;  ///< largest radius [m]
    int cells = 1;     ///< per axis
    std::vector<std::vector<Sphere>> held;
  };
  Vec3i cell(const Octave& octave, const Vec3& x) const {
    return (octave.cells * (x - domain_.box.lo).cwiseQuotient(domain_.box.size()))
        .array()
        .floor()
        .cast<int>();
  }
  static std::size_t slot(const Octave& octave, Vec3i at) {
    const int n = octave.cells;
    for (int k = 0; k < 3; ++k) at[k] = (at[k] % n + n) % n;
    return static_cast<std::size_t>(at.x() + n * (at.y() + n * at.z()));
  }

  Domain domain_;
  double smallest_;
  std::vector<Octave> octaves_;
};

Domain periodic_cube(double side) {
  Domain domain;
  domain.box = {Vec3::Zero(), Vec3::Constant(side)};
  domain.low.fill(Face::periodic);
  domain.high.fill(Face::periodic);
  return domain;
}

/// Rocks at random free places, the largest first; their bounding spheres do not meet.
std::vector<NewRock> scatter(const BedRecipe& recipe, const Domain& cell, Random& random) {
  std::vector<double> sizes = recipe.sizes;
  std::sort(sizes.rbegin(), sizes.rend());
  const double bounding = recipe.shape.bounding_radius;
  Crowd crowd(cell, bounding * sizes.back(), bounding * sizes.front());
  std::vector<NewRock> rocks;
  for (const double size : sizes) {
    Vec3 x;
    int trials = 0;
    do {
      if (++trials > most_trials) throw std::runtime_error("no place for a rock: fill the cell less");
      for (int k = 0; k < 3; ++k) x[k] = random.uniform(cell.box.lo[k], cell.box.hi[k]);
    } while (crowd.meets(x, bounding * size));
    crowd.add(x, bounding * size);
    rocks.push_back({.x = x, .q = random.rotation(), .size = size});
  }
  return rocks;
}

/// Size class of a rock: octaves above the smallest.
int octave_of(double size, double smallest) {
  return static_cast<int>(std::log2(size / smallest) + 1e-9);
}

/// Shrinks the cell until rocks touch as many others as asked. Contacts forget at the start of each
/// stage. A rock's density falls with its octave here, so that large rocks give way in about
/// as many steps as small ones. Returns the cell.
Domain press(const BedRecipe& recipe, Domain cell, std::vector<NewRock>& rocks) {
  const auto [smallest, largest] = std::minmax_element(recipe.sizes.begin(), recipe.sizes.end());
  const int octaves = octave_of(*largest, *smallest) + 1;
  DemConfig config = config_of_beds();
  config.overlap_limit = 4;
  const Walls none;
  const double per_rock = 2 / static_cast<double>(rocks.size());
  const double most = recipe.first_shrink;
  double by = most;
  for (int stage = 0; stage < most_stages; ++stage) {
    cell.box.hi *= 1 - by;
    DemScene scene = scene_for(recipe.shape, *smallest, *largest, {});
    scene.materials.all.clear();
    for (int o = 0; o < octaves; ++o) scene.materials.all.push_back({"rock", std::ldexp(density, -o)});
    scene.materials.pairs.assign(static_cast<std::size_t>(octaves * octaves),
                                 {set_up_restitution, set_up_friction, 0});
    scene.domain = cell;
    DemSystem dem(config, scene, none);
    for (NewRock& rock : rocks) {
      rock.x *= 1 - by;
      NewRock light = rock;
      light.material = octave_of(rock.size, *smallest);
      dem.add(light);
    }
    // The step that the system asks for is that of the smallest rock at the least density.
    const double dt = dem.step_size() * std::sqrt(std::ldexp(1.0, octaves - 1));
    double t = 0;
    const auto coordination_after = [&](int steps) {
      for (int k = 0; k < steps; ++k, t += dt) dem.step(t, dt);
      return per_rock * static_cast<double>(dem.contact_count());
    };
    double coordination = coordination_after(recipe.steps_per_stage);
    if (coordination > recipe.coordination) coordination = coordination_after(4 * recipe.steps_per_stage);
    for (std::size_t k = 0; k < rocks.size(); ++k) {
      NewRock& rock = rocks[dem.rocks().id[k]];  // the system may have sorted them
      rock.x = dem.rocks().x[k];
      rock.q = dem.rocks().q[k];
      rock.v = dem.rocks().v[k];
    }
    if (coordination > recipe.coordination) return cell;
    by = std::max(last_shrink, coordination > 0.5 * recipe.coordination    ? 0.1 * most
                               : coordination > 0.25 * recipe.coordination ? 0.3 * most
                                                                           : most);
  }
  throw std::runtime_error("the rocks could not be pressed together");
}
/// Takes out small rocks that the large ones have closed in on, and then the smallest beyond `keep`.
void take_out_shut_in(const Domain& cell, std::size_t keep, std::vector<NewRock>& rocks) {
  std::vector<Vec3> x;
  std::vector<double> radius;
  for (const NewRock& rock : rocks) {
    x.push_back(cell.wrapped(rock.x));
    radius.push_back(0.5 * rock.size);
  }
  for (const auto& [i, j] : overlapping_spheres(x, radius, cell)) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);  // the smaller one is b
    const double overlap = radius[a] + radius[b] - cell.nearest_image(x[b] - x[a]).norm();
    if (overlap > shut_in * radius[b] && rocks[a].size > 0) rocks[b].size = 0;
  }
  std::erase_if(rocks, [](const NewRock& rock) { return rock.size == 0; });
  if (rocks.size() < keep) throw std::runtime_error("too many rocks were shut in");
  rocks.resize(keep);
}
}  // namespace

DemConfig config_of_beds() {
  DemConfig config;
  config.stiffness_per_size = stiffness_per_size;
  config.tangential_ratio = tangential_ratio;
  return config;
}

DemScene scene_of(const Bed& bed) {
  DemScene scene = scene_for(bed.shape, bed.smallest, bed.largest, {restitution, friction, 0});
  scene.domain = bed.domain;
  return scene;
}

void add_rocks(const Bed& bed, DemSystem& dem) {
  for (const NewRock& rock : bed.rocks) dem.add(rock);
}

Bed make_bed(const BedRecipe& recipe) {
  double volume = 0;
  for (const double size : recipe.sizes) volume += recipe.shape.volume * size * size * size;
  Random random(1);
  const Domain loose = periodic_cube(std::cbrt(volume / recipe.first_fraction));
  std::vector<NewRock> rocks = scatter(recipe, loose, random);
  const Domain cell = press(recipe, loose, rocks);
  if (recipe.keep > 0) take_out_shut_in(cell, recipe.keep, rocks);

  Bed bed;
  bed.shape = recipe.shape;
  const auto [smallest, largest] = std::minmax_element(recipe.sizes.begin(), recipe.sizes.end());
  bed.smallest = *smallest;
  bed.largest = *largest;
  bed.domain = cell;
  const Vec3 side = cell.box.size();
  for (int k = 0; k < 3; ++k) bed.domain.box.hi[k] *= recipe.copies[static_cast<std::size_t>(k)];
  const double wave = 2 * std::numbers::pi / bed.domain.box.hi.z();
  const auto [nx, ny, nz] = recipe.copies;
  for (int copy = 0; copy < nx * ny * nz; ++copy) {
    const Vec3 offset = side.cwiseProduct(Vec3(copy % nx, copy / nx % ny, copy / (nx * ny)));
    for (NewRock rock : rocks) {
      rock.x += offset;
      // A little noise, or the copies of a cell would stay copies.
      rock.v = shear_speed * (Vec3(std::sin(wave * rock.x.z()), 0, 0) + 0.02 * random.on_sphere());
      bed.rocks.push_back(rock);
    }
  }
  return bed;
}

BedRecipe dense_200k() {
  BedRecipe recipe;
  recipe.sizes.assign(3125, 0.02);
  recipe.coordination = 4.6;
  recipe.copies = {4, 4, 4};
  return recipe;
}

BedRecipe poly5_50k() {
  BedRecipe recipe;
  for (int i = 0; i < 3125; ++i) recipe.sizes.push_back(0.004 + 0.016 * i / 3124);
  recipe.copies = {4, 2, 2};
  recipe.first_shrink = 0.0045;
  recipe.coordination = 4.1;
  return recipe;
}

BedRecipe poly50_50k() {
  constexpr int count = 54500;
  constexpr double ratio = 50, modulus = 0.7, least = 0.002;
  BedRecipe recipe;
  // Number of rocks above d: (d/d_min)^(modulus - 3), both ends included.
  const double power = modulus - 3, last = std::pow(ratio, power);
  for (int i = 0; i < count; ++i)
    recipe.sizes.push_back(least * std::pow(1 + (last - 1) * i / (count - 1), 1 / power));
  recipe.keep = 50000;
  recipe.overlap_limit = 1;  // lumps of 50 times its size close in on a grain
  recipe.first_fraction = 0.5;
  recipe.first_shrink = 0.003;
  recipe.coordination = 2;
  recipe.steps_per_stage = 10;
  return recipe;
}

BedRecipe superquadrics_30k(const RockShape& shape) {
  BedRecipe recipe;
  recipe.shape = shape;
  recipe.sizes.assign(600, 0.01);
  recipe.first_fraction = 0.25 * shape.volume / (4.18879 * std::pow(shape.bounding_radius, 3));
  recipe.copies = {5, 5, 2};
  recipe.coordination = 5.5;
  return recipe;
}

}  // namespace sluice::speed
