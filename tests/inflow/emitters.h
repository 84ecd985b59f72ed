#pragma once
/// Small emitters for the tests of pipes and nozzles.

#include <numbers>

#include "inflow/fake_fluid.h"
#include "inflow/pipe_jet.h"
#include "inflow/spray_nozzle.h"

namespace sluice::test {

constexpr double spacing = 0.01;  // of the points [m]

inline PipeJetConfig pipe(double flow) {
  PipeJetConfig c;
  c.name = "pipe";
  c.bore = 0.09;
  c.outlets.direction = Vec3(0, 0, -2);
  c.outlets.flow = flow;
  return c;
}

inline SprayNozzleConfig nozzle() {
  SprayNozzleConfig c;
  c.name = "nozzle";
  c.rated_flow = 2e-3;
  c.rated_pressure = 2e5;
  c.angle = std::numbers::pi / 2;
  c.pressure = 2e5;
  c.outlets.direction = Vec3(0, 0, -1);
  return c;
}

inline InflowTarget into(FakeFluid& fluid) {
  InflowTarget target;
  target.water = &fluid;
  target.seed = 7;
  return target;
}

/// Runs for n steps without moving the water.
inline void feed(Inflow& inflow, int n, double dt, double t = 0) {
  for (int i = 0; i < n; ++i) inflow.advance(t + i * dt, dt);
}

}  // namespace sluice::test
