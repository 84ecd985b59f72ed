#pragma once
/// Water driven through a bed of rocks that are held: speed and drag where they balance, over the grid's
/// spacing.
///
/// The box is periodic, the rocks stand on a lattice, a little out of order. A body force on the water alone
/// is what a gradient of pressure is in a pipe. Reference: columns `diameter` [m], `void_fraction`, `drive`
/// [m/s2] and `speed`, superficial [m/s], or `drag` per rock [N].

#include "coupling/coupling.h"
#include "validation/measure.h"

namespace sluice {

enum class BedReading { speed, drag };

struct CouplingBed : Measure {
  std::int64_t cells = 4;  ///< of the water's grid along the box
  BedReading read = BedReading::speed;
  DragModel drag = DragModel::gidaspow;
  std::int64_t lattice_cells = 6;  ///< of face-centred cubes of rocks along the box
  double seconds = 0.6;            ///< the last fifth of which is read [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
