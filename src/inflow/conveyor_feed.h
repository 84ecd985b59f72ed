#pragma once
/// Rock that arrives on a conveyor belt.
///
/// Rocks are drawn in a fixed order (sizes by number from the curve by mass, shapes from the mix) whether or
/// not there is room, so that room does not bias the sizes. Those that are due wait in a short list and are
/// set down at random places of a band upstream on the belt, each as low as it fits, at belt speed. Small
/// ones may pass a large one that waits, but only for the time in which the belt clears the band; then it
/// goes first. Fines and moisture enter as slurry (belt_slurry.h).

#include <memory>

#include "inflow/belt_frame.h"
#include "inflow/inflow.h"
#include "inflow/shape_mix.h"
#include "inflow/size_distribution.h"

namespace sluice {

enum class BelowCutoff { slurry, leave_out };
enum class BedProfile {
  flat,    ///< one depth over the width
  heaped,  ///< a parabola, zero at the edges
};

/// Keys of an inflow with `kind: conveyor`.
struct ConveyorFeedConfig {
  std::string name;
  double rate = 0;               ///< dry rock, fines included [kg/s]
  double belt_speed = 0;         ///< [m/s]
  Vec3 position = Vec3::Zero();  ///< middle of the belt at the front edge of the band [m]
  Vec3 travel = Vec3::Zero();    ///< direction of the belt; any length
  double burden_width = 0;       ///< [m]
  double offset = 0;             ///< of the burden across the belt, to the left of travel [m]
  double bed_depth = 0;          ///< largest height of the burden [m]
  BedProfile profile = BedProfile::flat;
  std::optional<double> band_length;  ///< [m]
  double moisture = 0;                ///< water over dry rock, by mass
  BelowCutoff below_cutoff = BelowCutoff::slurry;
  std::string material;
  SizeDistributionConfig sizes;
  ShapeMixConfig shapes;
  double start = 0;            ///< [s]
  std::optional<double> stop;  ///< [s]
  Location where;
  void keys(Schema& s);
};

/// Share of a heap that is rock: loose, broken rock.
inline constexpr double bulk_fraction = 0.6;

/// Largest rate that the stated bed carries [kg/s]: cross-section x belt speed x bulk density.
double feed_capacity(const ConveyorFeedConfig& config, double density);

/// The band in space.
/// @param widest  bounding diameter of the largest rock [m];  @param gravity  says which way is up
BeltFrame belt_frame(const ConveyorFeedConfig& config, double widest, const Vec3& gravity);

/// @param mix  made from config.shapes for the shape table of the rocks' scene
/// @throws InputError: no rocks, unknown material, a rate that does not fit the bed, a band outside the
/// domain,
///         slurry without water or too thick to flow
std::unique_ptr<Inflow> make_conveyor_feed(const ConveyorFeedConfig& config, const ShapeMix& mix,
                                           const InflowTarget& target);

}  // namespace sluice
