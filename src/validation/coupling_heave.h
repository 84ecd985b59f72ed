#pragma once
/// Resolved bodies that float: how deep they lie, and how long a sphere takes to go up and down.
///
/// The tank is five bodies wide and two deep, closed. For the period the body, half as dense as water, starts
/// a tenth of its size above where it floats; read is the time between its first and its third pass there,
/// before waves come back from the walls. For the draft it starts where it floats, and its mean height over
/// the second half of the time is read.
///
/// Reference: rows `what`, `value`, `scale`: `sphere_period` [s], `sphere_draft`, `box_draft` (over the
/// height; the box is a superquadric of exponent 16, 3 : 3 : 2).

#include "validation/measure.h"

namespace sluice {

struct CouplingHeave : Measure {
  double size_cells = 6;  ///< of the body's height
  double size = 0.3;      ///< of the body's height [m]
  double seconds = 1.2;   ///< for the draft

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
