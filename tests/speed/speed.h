#pragma once
/// Wall-clock rates. Google Benchmark adds suffixes to a benchmark's name where it is told to use real time
/// or a number of iterations; the names here are an interface, so the clock is ours.

#include <benchmark/benchmark.h>

#include <chrono>

namespace sluice::speed {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs `step` until the benchmark has seen enough; returns the seconds of wall time.
template <class Step>
double time_steps(benchmark::State& state, const Step& step) {
  const Stopwatch watch;
  for (auto _ : state) step();
  return watch.seconds();
}

/// Rate of `per_step` things [1/s]. @param seconds  of all steps together
inline double rate(const benchmark::State& state, double per_step, double seconds) {
  return per_step * static_cast<double>(state.iterations()) / seconds;
}

}  // namespace sluice::speed
