#pragma once
/// Materials and what happens where two of them touch.

#include <string>
#include <vector>

namespace sluice {

struct Material {
  std::string name;
  double density = 0;  ///< [kg/m3]; 0 for materials that only walls have
};

/// One pair of materials.
struct PairProperties {
  double restitution = 0.3;  ///< normal, in (0, 1]
  double friction = 0.5;     ///< Coulomb coefficient, sliding and static
  double rolling = 0;        ///< rolling resistance coefficient (torque <= rolling * R * F_n)
};

struct Materials {
  std::vector<Material> all;
  std::vector<PairProperties> pairs;  ///< n x n, symmetric, row-major

  const PairProperties& pair(int a, int b) const {
    return pairs[static_cast<std::size_t>(a) * all.size() + static_cast<std::size_t>(b)];
  }
};

}  // namespace sluice
