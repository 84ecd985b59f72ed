#include "processes/check_places.h"

#include <fmt/format.h>

namespace sluice {

std::string reach_of(const Box& box) {
  return fmt::format("[{:.3g}, {:.3g}, {:.3g}] .. [{:.3g}, {:.3g}, {:.3g}] m", box.lo.x(), box.lo.y(),
                     box.lo.z(), box.hi.x(), box.hi.y(), box.hi.z());
}

namespace {

std::string words(const Vec3& x) {
  return fmt::format("[{:.3g}, {:.3g}, {:.3g}]", x.x(), x.y(), x.z());
}

/// What the grid of the water can number.
constexpr double most_cells_along = 1e6;

class PlaceCheck {
 public:
  explicit PlaceCheck(const ProcessConfig& config) : config_(config), domain_(config.domain.domain()) {}

  void outlets(const Location& where, const OutletRow& row) {
    for (const Vec3& x : row.open_outlets())
      if (domain_.outside(x)) {
        refuse(where, "position", fmt::format("puts an outlet at {} m", words(x)), outside(),
               "move it inside or enlarge the domain");
        return;
      }
  }

  void box(const Location& where, const Box& box) {
    if (!domain_.box.overlaps(box))
      refuse(where, "low", fmt::format("begins a box in {}", reach_of(box)), outside(),
             "move it inside or enlarge the domain");
  }

  void gauge(const GaugeConfig& gauge) {
    const Box& all = domain_.box;
    if (gauge.low && gauge.high) box(gauge.where, {*gauge.low, *gauge.high});
    if (gauge.kind != GaugeKind::level) return;
    if (gauge.x < all.lo.x() || gauge.x > all.hi.x())
      refuse(gauge.where, "x", fmt::format("is {:.3g} m", gauge.x), outside(), "move the gauge inside");
    if (gauge.y < all.lo.y() || gauge.y > all.hi.y())
      refuse(gauge.where, "y", fmt::format("is {:.3g} m", gauge.y), outside(), "move the gauge inside");
  }

  void spacing(double spacing) {
    const double thinnest = domain_.box.size().minCoeff();
    if (domain_.box.size().maxCoeff() / spacing > most_cells_along)
      refuse(config_.water_at, "spacing", fmt::format("is {:.3g} m", spacing),
             "the domain would have more than a million cells along an axis",
             "use larger cells or a smaller domain");
    if (spacing > thinnest)
      refuse(config_.water_at, "spacing", fmt::format("is {:.3g} m", spacing),
             fmt::format("the domain is {:.3g} m thin", thinnest), "use cells that fit into the domain");
  }

  std::vector<InputProblem> take() { return std::move(problems_); }

 private:
  std::string outside() const { return fmt::format("the domain reaches {}", reach_of(domain_.box)); }
  void refuse(const Location& where, const std::string& key, const std::string& problem,
              const std::string& reason, const std::string& suggestion) {
    problems_.push_back({where, key, problem, reason, suggestion});
  }

  const ProcessConfig& config_;
  Domain domain_;
  std::vector<InputProblem> problems_;
};

}  // namespace

std::vector<InputProblem> misplaced(const ProcessConfig& config) {
  PlaceCheck check(config);
  for (const PipeJetConfig& pipe : config.pipes) check.outlets(pipe.where, pipe.outlets);
  for (const ChannelInflowConfig& channel : config.channels) check.outlets(channel.where, channel.outlets);
  for (const SprayNozzleConfig& spray : config.sprays) check.outlets(spray.where, spray.outlets);
  for (const GaugeConfig& gauge : config.gauges) check.gauge(gauge);
  for (const MixingConfig& mixing : config.mixing) check.box(mixing.where, {mixing.low, mixing.high});
  if (config.water) check.spacing(config.water->spacing);
  return check.take();
}

}  // namespace sluice
