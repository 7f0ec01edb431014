// A small dynamics that lives on what tact reports: set positions, detect, respond.
#pragma once

#include <tact/recording.h>
#include <tact/tact.h>

#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <vector>

#include "engine/base/timer.h"
#include "scenes/dynamics/body.h"
#include "scenes/dynamics/contact_solver.h"
#include "scenes/dynamics/dynamics_settings.h"
#include "scenes/dynamics/impact_response.h"
#include "scenes/dynamics/sleep.h"

namespace tact::scenes {

// Moves the bodies that are not dynamic: sets their positions as they are at `time`, seconds. It may change the weight
// of the others, hold some of their vertices (inverse mass 0) and move these; a body that sleeps has to be woken for
// it.
using Script = std::function<void(double time, std::vector<Body>& bodies)>;

// What a step of the simulation took, wall time in milliseconds.
struct DynamicsTimes {
  double move_ms = 0.0;       // motion, springs, volumes, shapes
  double contacts_ms = 0.0;   // taking contact points and keeping them apart
  double impacts_ms = 0.0;    // stopping before impacts, tact's part of it included
  double engine_ms = 0.0;     // setting positions and detecting: tact
  double sleep_ms = 0.0;      // damping, sleep, energies
  double recording_ms = 0.0;  // writing what entered the engine; in none of the others
  // The same, stretch by stretch, as they followed each other; recording is in that of the engine.
  struct Stretch {
    const char* name;
    std::chrono::steady_clock::time_point begin, end;
  };
  std::vector<Stretch> stretches = {};
  double total_ms() const { return move_ms + contacts_ms + impacts_ms + engine_ms + sleep_ms; }
};

// How a step of the simulation went.
struct DynamicsState {
  double time = 0.0;            // seconds simulated
  double kinetic_energy = 0.0;  // joules
  std::int64_t contact_points = 0;
  int detections = 0;       // in this step
  std::int64_t awake = 0;   // bodies that forces move
  std::int64_t asleep = 0;  // likewise
  // How much of both thicknesses two surfaces took from each other when that was found, and how far they had crossed,
  // over the size of the smaller body.
  double squeezed = 0.0;
  double crossed = 0.0;
  double smallest_gap = std::numeric_limits<double>::infinity();  // of a contact point, metres
  // Facets that cross, of all detections: of two bodies, of a body with itself.
  std::int64_t facet_pairs = 0;
  std::int64_t self_facet_pairs = 0;
  // Where impacts are stopped: how many, and how many vertices stayed where they were, see ImpactResponse.
  std::int64_t impacts = 0;
  std::int64_t stayed = 0;
};

// Bodies, the world of tact that finds their contacts, and the step. The same bits for any number of threads.
//
// Bodies are soft and cloth by XPBD with small substeps (M. Macklin et al., XPBD, MIG 2016; Small Steps in Physics
// Simulation, SCA 2019; M. Müller et al., Position Based Dynamics, VRIPhys 2006), or rigid (Müller et al., Detailed
// Rigid Body Simulation with Extended Position Based Dynamics, SCA 2020). A substep moves each of them by itself, then
// keeps apart what the last detection found near each other. The next detection comes at the end of the step, or as
// soon as a body may have moved farther than its reach: what is not among the contact points cannot have met till then.
class Simulation {
 public:
  // The bodies keep their order: body i has index i in every report, which has contact points whether or not `settings`
  // asks for them. To `recording`, if not null, goes what enters the engine; writing it is in none of the times.
  // Errors: those of World and World::add_body.
  Simulation(std::vector<Body> bodies, Script script, const DynamicsSettings& dynamics, const Settings& settings,
             std::ostream* recording = nullptr);

  void step();

  const std::vector<Body>& bodies() const { return bodies_; }
  const World& world() const { return world_; }
  // Of the last detection, which ended the last step; null before the first.
  const Report* report() const { return report_; }
  // Summed over the detections of the last step; what counts the bodies of the world, too.
  const StepStats& stats() const { return stats_; }
  const DynamicsState& state() const { return state_; }
  const DynamicsTimes& times() const { return times_; }
  const ImpactResponse& impacts() const { return impacts_; }
  const DynamicsSettings& dynamics() const { return dynamics_; }

 private:
  // What recording took so far.
  double writing_ms() const { return recorder_ ? recorder_->writing_ms() : 0.0; }
  BodyId add_to_world(const Body& body, double margin);
  void run_substep(double h);
  void follow_facets(std::size_t body);
  bool has_left_its_reach(double h) const;
  void set_reach(std::size_t body);
  void limit_ways();
  bool stops_impacts() const { return dynamics_.continuous || dynamics_.guarded; }
  void stop_before_impacts();
  void detect();
  void measure_contacts();
  void rest();
  // Ends a stretch of the step; tells what it took, milliseconds.
  double note(const char* name, base::Timer& timer);
  // Calls work(i, threads) for every body that is not fixed nor asleep: small ones in parallel, large ones one by one
  // on all threads.
  template <class Work>
  void for_each_body(const Work& work);

  DynamicsSettings dynamics_;
  Script script_;
  int threads_;
  std::vector<Body> bodies_;
  std::optional<Recorder> recorder_;  // outlives the world
  World world_;
  std::vector<BodyId> ids_;
  std::vector<std::size_t> small_, large_;   // bodies that can move
  std::vector<std::vector<Vec3>> before_;    // positions at the start of the substep, by body
  std::vector<std::vector<Vec3>> detected_;  // and at the last detection, where impacts are stopped
  double detected_time_ = 0.0;               // of it, seconds
  std::vector<double> reach_;                // by body, metres
  std::vector<double> free_;                 // by body: how far it may go until the next detection, metres
  std::vector<double> last_way_, way_;       // by body: no vertex went farther in the last substep; since the
                                             // last detection; metres
  ContactSolver solver_;
  ImpactResponse impacts_;
  Sleep sleep_;
  bool facets_changed_ = false;  // since the last detection
  const Report* report_ = nullptr;
  StepStats stats_;
  DynamicsState state_;
  DynamicsTimes times_;
};

}  // namespace tact::scenes
