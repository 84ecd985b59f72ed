#pragma once
/// The front of a column of water that collapses on a dry floor, over cells in its height.
///
/// Reference: columns `slope` and `scale`, what a difference of slopes is measured against, of the measured
/// front: dZ/dT between Z = 1.45 and `last`, with Z the front's distance from the closed end over the
/// column's width and T = t sqrt(g H) / width. The whole curve is read from `curve`: points between these
/// places, after one shift in time, since experiments do not know when their gate was gone.

#include "validation/measure.h"

namespace sluice {

struct WaterFront : Measure {
  double cells = 16;                           ///< in the height
  double height = 0.6;                         ///< of the column [m]
  double width = 0.6;                          ///< of the column [m]
  double last = 2.6;                           ///< Z up to which it is followed
  std::string curve, time = "T", place = "Z";  ///< file, and its columns
  std::string series;                          ///< of that file; empty: all of it

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
