#include "validation/measures.h"

#include "validation/analysis_mixing.h"
#include "validation/analysis_residence.h"
#include "validation/analysis_sizes.h"
#include "validation/coupling_added_mass.h"
#include "validation/coupling_bed.h"
#include "validation/coupling_dam.h"
#include "validation/coupling_heave.h"
#include "validation/coupling_hindered.h"
#include "validation/coupling_jet.h"
#include "validation/coupling_settling.h"
#include "validation/coupling_sphere.h"
#include "validation/coupling_stream.h"
#include "validation/coupling_third_law.h"
#include "validation/coupling_turning.h"
#include "validation/emitter_flux.h"
#include "validation/rock_bed_energy.h"
#include "validation/rock_bounces.h"
#include "validation/rock_deck.h"
#include "validation/rock_hertz.h"
#include "validation/rock_hertz_oblique.h"
#include "validation/rock_hertz_rebound.h"
#include "validation/rock_hopper.h"
#include "validation/rock_incline.h"
#include "validation/rock_oblique.h"
#include "validation/rock_rebound.h"
#include "validation/rock_repose.h"
#include "validation/rock_rotation.h"
#include "validation/rock_slide_to_roll.h"
#include "validation/rock_stack.h"
#include "validation/water_channel.h"
#include "validation/water_dam_break.h"
#include "validation/water_film.h"
#include "validation/water_front.h"
#include "validation/water_jet.h"
#include "validation/water_launder.h"
#include "validation/water_plate.h"
#include "validation/water_sloshing.h"
#include "validation/water_slot.h"
#include "validation/water_still.h"
#include "validation/water_taylor_green.h"
#include "validation/water_tilted.h"

namespace sluice {

namespace {

template <class T>
std::unique_ptr<Measure> made() {
  return std::make_unique<T>();
}

}  // namespace

const std::vector<MeasureKind>& measure_kinds() {
  static const std::vector<MeasureKind> kinds{
      {"rock_rebound", "rock", made<RockRebound>},
      {"rock_oblique", "rock", made<RockOblique>},
      {"rock_bounces", "rock", made<RockBounces>},
      {"rock_slide_to_roll", "rock", made<RockSlideToRoll>},
      {"rock_incline", "rock", made<RockIncline>},
      {"rock_rotation", "rock", made<RockRotation>},
      {"rock_stack", "rock", made<RockStack>},
      {"rock_bed_energy", "rock", made<RockBedEnergy>},
      {"rock_hertz", "rock", made<RockHertz>},
      {"rock_hertz_rebound", "rock", made<RockHertzRebound>},
      {"rock_hertz_oblique", "rock", made<RockHertzOblique>},
      {"rock_deck", "rock", made<RockDeck>},
      {"rock_repose", "rock", made<RockRepose>},
      {"rock_hopper", "rock", made<RockHopper>},
      {"water_still", "point", made<WaterStill>},
      {"water_taylor_green", "point", made<WaterTaylorGreen>},
      {"water_channel", "point", made<WaterChannel>},
      {"water_sloshing", "point", made<WaterSloshing>},
      {"water_wave_decay", "point", made<WaterWaveDecay>},
      {"water_tilted", "point", made<WaterTilted>},
      {"water_dam_break", "point", made<WaterDamBreak>},
      {"water_front", "point", made<WaterFront>},
      {"water_jet", "point", made<WaterJet>},
      {"water_plate", "point", made<WaterPlate>},
      {"water_film", "point", made<WaterFilm>},
      {"water_launder", "point", made<WaterLaunder>},
      {"water_slot", "point", made<WaterSlot>},
      {"coupling_settling", "point", made<CouplingSettling>},
      {"coupling_hindered", "point", made<CouplingHindered>},
      {"coupling_bed", "point", made<CouplingBed>},
      {"coupling_sphere", "point", made<CouplingSphere>},
      {"coupling_stream", "point", made<CouplingStream>},
      {"coupling_jet", "point", made<CouplingJet>},
      {"coupling_turning", "point", made<CouplingTurning>},
      {"coupling_added_mass", "point", made<CouplingAddedMass>},
      {"coupling_dam", "point", made<CouplingDam>},
      {"coupling_heave", "point", made<CouplingHeave>},
      {"coupling_third_law", "point", made<CouplingThirdLaw>},
      {"emitter_flux", "sample", made<EmitterFlux>},
      {"analysis_mixing", "sample", made<AnalysisMixing>},
      {"analysis_residence", "sample", made<AnalysisResidence>},
      {"analysis_sizes", "sample", made<AnalysisSizes>},
  };
  return kinds;
}

const MeasureKind* find_measure(const std::string& word) {
  for (const MeasureKind& kind : measure_kinds())
    if (word == kind.word) return &kind;
  return nullptr;
}

}  // namespace sluice
