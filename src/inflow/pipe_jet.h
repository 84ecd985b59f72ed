#pragma once
/// Round water jets from open pipe ends.
///
///    ____________        discs of points travel with the jet; each disc holds whole rings of equal flux, so
///   |            :::     that every point carries the same mass and the density is even over the bore, for a
///   |____________:::     flat as for a turbulent profile. Rings turn from disc to disc and points are
///   jittered.

#include <memory>

#include "inflow/inflow.h"
#include "inflow/outlets.h"

namespace sluice {

enum class JetProfile {
  flat,       ///< one speed over the bore
  turbulent,  ///< (1 - r/R)^(1/7), Prandtl; mean over largest speed 49/60
};

/// Keys of an inflow with `kind: pipe`.
struct PipeJetConfig {
  std::string name;
  double bore = 0;  ///< inner diameter [m]
  JetProfile profile = JetProfile::flat;
  OutletRow outlets;
  Location where;
  void keys(Schema& s);
  double speed() const;  ///< mean over the bore [m/s]
};

/// @throws InputError where the scene has no water
std::unique_ptr<Inflow> make_pipe_jet(const PipeJetConfig& config, const InflowTarget& target);

/// Radius over R inside which the share F of the flow passes.
double flux_radius(JetProfile profile, double F);
/// Speed at radius r/R over the mean speed.
double profile_speed(JetProfile profile, double r);

}  // namespace sluice
