#pragma once
/// How well water and rock are mixed.
///
/// A box is cut into slabs along an axis and the slabs into cells; x = share of water in the volume of water
/// and rock in a cell. Lacey (1954): M = (s0^2 - s^2) / (s0^2 - sR^2), 0 apart and 1 at random; s0^2 = p (1 -
/// p) and sR^2 for grains of unequal size as Poole, Taylor & Wall (1964) have it: p q (p v_q + q v_p) / V
/// with the effective grain volumes v = sum v^2 / sum v and the cell's content V. A rock counts in the cell
/// of its centre, so cells should be about two top sizes or larger: where a cell holds so few grains that
/// s0^2 is no more than twice sR^2, the index is noise over noise and NaN.

#include <string>
#include <vector>

#include "analysis/probe.h"
#include "base/schema.h"

namespace sluice {

/// Amounts of the two components in one cell.
struct MixCell {
  double a = 0, b = 0;
};

/// NaN where one component is absent or fewer than two cells hold anything.
struct MixIndices {
  double share = 0;        ///< p, of a in all
  double variance = 0;     ///< s^2 of the cells' shares, weighted by their content
  double lacey = 0;        ///< NaN too where the cells are too small for the grains: s0^2 <= 2 sR^2
  double rsd = 0;          ///< s / p
  double segregation = 0;  ///< Danckwerts (1952): s^2 / s0^2, 1 apart and 0 mixed
};

/// @param grain_a, grain_b  effective grain amounts, sum v^2 / sum v
MixIndices mix_indices(const std::vector<MixCell>& cells, double grain_a, double grain_b);

/// Keys under `mixing: NAME:`.
struct MixingConfig {
  std::string name;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box [m]
  int axis = 2;                                  ///< along which slabs lie
  std::int64_t slabs = 10;
  double cell = 0;        ///< edge of a cell [m]
  double interval = 0.1;  ///< [s]
  Location where;         ///< of the mapping, for messages
  void keys(Schema& s);
};

/// One line of mixing.csv.
struct MixingRow {
  double t = 0;         ///< [s]
  double position = 0;  ///< middle of the slab along the axis [m]
  double rock_kg = 0, water_kg = 0;
  double lacey = 0, rsd = 0, segregation = 0;
  double wetted = 0;     ///< of the rock, by mass: mean wetted fraction now
  double met_water = 0;  ///< share of the rock's mass that has met water so far
};

class MixingProbe : public Probe {
 public:
  explicit MixingProbe(MixingConfig config);
  const std::string& name() const override { return config_.name; }
  double interval() const override { return config_.interval; }
  void look(const SceneView& scene) override;
  std::vector<std::string> columns() const override;
  std::vector<double> values() const override;
  void exchange(StateArchive& archive) override;
  const MixingConfig& config() const { return config_; }
  const std::vector<MixingRow>& rows() const { return rows_; }  ///< of all looks so far

 private:
  MixingConfig config_;
  std::vector<MixingRow> rows_;
  MixIndices whole_;  ///< of the box at the last look
};

}  // namespace sluice
