#pragma once
/// Materials and what happens where two of them touch.

#include <string>
#include <vector>

namespace sluice {

struct Material {
  std::string name;
  double density = 0;         ///< [kg/m3]; 0 for materials that only walls have
  double youngs_modulus = 0;  ///< [Pa]; 0 where no law asks for it
  double poissons_ratio = 0;  ///< in (-1, 0.5]
};

/// Where the force of a contact comes from.
enum class ForceLaw {
  linear,         ///< spring and dashpot; its stiffness is chosen so that rocks overlap little
  hertz_mindlin,  ///< elastic spheres; its stiffness is that of the materials
};

/// What a contact of hertz_mindlin does across its normal.
enum class Tangential {
  rescaled,       ///< one spring; none of its changes of stiffness makes energy
  whole_stretch,  ///< one spring, its force stiffness times stretch at any overlap; may make energy
  partial_slip,   ///< springs in rings, which slip from the rim inwards
};

/// One pair of materials.
struct PairProperties {
  double restitution = 0.3;  ///< normal, in (0, 1]
  double friction = 0.5;     ///< Coulomb coefficient, sliding and static
  double rolling = 0;        ///< rolling resistance coefficient (torque <= rolling * R * F_n)
  ForceLaw law = ForceLaw::linear;
  Tangential tangential = Tangential::rescaled;  ///< of hertz_mindlin
  double adhesion = 0;                           ///< pull-off force over effective radius [N/m]
  bool meets = true;                             ///< false: the two never touch, and ask for no stiffness
};

struct Materials {
  std::vector<Material> all;
  std::vector<PairProperties> pairs;  ///< n x n, symmetric, row-major

  const PairProperties& pair(int a, int b) const {
    return pairs[static_cast<std::size_t>(a) * all.size() + static_cast<std::size_t>(b)];
  }
};

}  // namespace sluice
