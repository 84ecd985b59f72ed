// The speeds that the cases deck-slide and deck-throw are held against, by a second way: a rigid rock in
// small steps of equal length (Moreau's time stepping) instead of from event to event.
#include "validation/rock_deck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "output/csv.h"

namespace sluice {
namespace {

constexpr double g = 9.81, restitution = 0.1;
constexpr double step = 2e-6;                      // [s]
constexpr double slowest_bounce = 100 * g * step;  // slower impacts do not bounce [m/s]

struct Deck {
  double tilt, friction, throw_angle, frequency, stroke;
};

/// @param slip_over_centre  by how much more an impulse along the deck changes the touching point's speed
/// than that of the centre: 1 for a block that does not turn, 7/2 for a ball
double transport_speed(const Deck& deck, double slip_over_centre) {
  constexpr double degree = std::numbers::pi / 180;
  const double w = 2 * std::numbers::pi * deck.frequency;
  const double across = std::cos(deck.throw_angle * degree), up = std::sin(deck.throw_angle * degree);
  const double a = 0.5 * deck.stroke * w * w;
  const auto steps = static_cast<std::int64_t>(std::ceil(1 / (deck.frequency * step)));
  const double dt = 1 / (deck.frequency * static_cast<double>(steps));
  // All relative to the deck, which starts at full speed.
  double slip = -a / w * across, centre = slip, v = -a / w * up, z = 0, x = 0, from = 0;
  for (std::int64_t n = 0; n < 60 * steps; ++n) {
    if (n == 20 * steps) from = x;
    const double s = a * std::sin(w * (static_cast<double>(n) + 0.5) * dt);
    const double drive = (g * std::sin(deck.tilt * degree) + across * s) * dt;
    v -= (g * std::cos(deck.tilt * degree) - up * s) * dt;
    slip += drive;
    centre += drive;
    if (z <= 0 && v < 0) {
      const double push = -v * (v < -slowest_bounce ? 1 + restitution : 1);
      const double most = slip_over_centre * deck.friction * push;
      const double taken = std::clamp(slip, -most, most);
      v += push;
      slip -= taken;
      centre -= taken / slip_over_centre;
    }
    z += v * dt;
    x += centre * dt;
  }
  return (x - from) * deck.frequency / 40;
}

void expect_speeds_of(const char* name, double slip_over_centre) {
  const CsvTable table = read_csv(std::filesystem::path(SLUICE_ROOT) / "validation" / name / "reference.csv");
  const auto column = [&](const char* what) { return reference_numbers(table, what); };
  const std::vector<double> tilt = column("tilt"), friction = column("friction"),
                            throw_angle = column("throw_angle"), frequency = column("frequency"),
                            stroke = column("stroke"), speed = column("speed");
  ASSERT_FALSE(speed.empty());
  for (std::size_t k = 0; k < speed.size(); ++k) {
    const double deck_speed = std::numbers::pi * frequency[k] * stroke[k];
    EXPECT_NEAR(
        transport_speed({tilt[k], friction[k], throw_angle[k], frequency[k], stroke[k]}, slip_over_centre),
        speed[k], 2e-3 * deck_speed)
        << name << ", row " << k;
  }
}

TEST(VibratingDeck, CarriesASlidingBlockAtTheSpeedOfTheReference) {
  expect_speeds_of("deck-slide", 1);
}

TEST(VibratingDeck, CarriesAThrownBallAtTheSpeedOfTheReference) {
  expect_speeds_of("deck-throw", 3.5);
}

}  // namespace
}  // namespace sluice
