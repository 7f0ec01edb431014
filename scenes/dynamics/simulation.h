// A small dynamics that lives on what tact reports: set positions, detect, respond.
#pragma once

#include <tact/recording.h>
#include <tact/tact.h>

#include <chrono>
#include <functional>
#include <optional>
#include <ostream>
#include <vector>

#include "scenes/dynamics/body.h"
#include "scenes/dynamics/contact_solver.h"
#include "scenes/dynamics/impact_response.h"
#include "scenes/dynamics/penetration.h"

namespace tact::scenes {

struct DynamicsSettings {
  double gravity = 9.81;           // metres a second², towards -z
  double time_step = 1.0 / 120.0;  // seconds from one detection to the next
  int substeps = 4;                // of the motion, between two detections
  int settle_sweeps = 2;           // pushes out of each other after a detection
  double slop = 0.0005;            // metres that bodies at rest stay in each other, so that their contact lasts
  // Stop bodies before they meet, rather than push them out of each other; skins are left away.
  bool continuous = false;
  double margin = 0.001;  // of every body then, metres: two surfaces stay two of these apart
};

// Moves the bodies that are not dynamic: sets their positions as they are at `time`, seconds. It may change the weight
// and the hull stiffness of the others.
using Script = std::function<void(double time, std::vector<Body>& bodies)>;

// What a step of the simulation took, wall time in milliseconds.
struct DynamicsTimes {
  double move_ms = 0.0;       // substeps
  double impacts_ms = 0.0;    // stopping before impacts, tact's part of it included
  double surfaces_ms = 0.0;   // moving surfaces out by their skin
  double engine_ms = 0.0;     // setting positions and detecting: tact
  double contacts_ms = 0.0;   // from facet pairs to contact points
  double settle_ms = 0.0;     // pushing out
  double recording_ms = 0.0;  // writing what entered the engine, between its two calls; in none of the others
  std::chrono::steady_clock::time_point begin = {};  // of the step: these follow in their order
  double total_ms() const { return move_ms + impacts_ms + surfaces_ms + engine_ms + contacts_ms + settle_ms; }
};

// How a step of the simulation went.
struct DynamicsState {
  double time = 0.0;            // seconds simulated
  double kinetic_energy = 0.0;  // joules
  std::int64_t contact_points = 0;
  // How far a point was inside another body when it was found, skins taken off, over the size of the smaller body.
  double deepest = 0.0;
};

// Bodies, the world of tact that finds their contacts, and the step. The same bits for any number of threads.
//
// Bodies are soft and cloth by XPBD with small substeps (M. Macklin et al., Small Steps in Physics Simulation, SCA
// 2019). A step moves them, with the contact points of the last detection as the only obstacles; detects; finds the new
// contact points from the report; and pushes the bodies out of each other, which changes no velocity. Where it is
// continuous, it moves them and stops what would meet on the way, before it detects. There is no contact of a body with
// itself.
class Simulation {
 public:
  // The bodies keep their order: body i has index i in every report. To `recording`, if not null, goes what enters the
  // engine; writing it is in none of the times. Errors: those of World and World::add_body.
  Simulation(std::vector<Body> bodies, Script script, const DynamicsSettings& dynamics, const Settings& settings,
             std::ostream* recording = nullptr);

  void step();

  const std::vector<Body>& bodies() const { return bodies_; }
  // The positions of body i that tact saw in the last step: moved out by its skin, before the pushes that followed.
  const std::vector<Vec3>& seen(std::size_t i) const { return seen_[i]; }
  const World& world() const { return world_; }
  // Of the last step; null before the first.
  const Report* report() const { return report_; }
  const DynamicsState& state() const { return state_; }
  const DynamicsTimes& times() const { return times_; }
  const ImpactResponse& impacts() const { return impacts_; }
  const DynamicsSettings& dynamics() const { return dynamics_; }

 private:
  // What recording took so far.
  double writing_ms() const { return recorder_ ? recorder_->writing_ms() : 0.0; }
  void move();
  void begin_substep(std::size_t body, double h, int threads);
  void end_substep(std::size_t body, double h, int threads);
  void show_surface(std::size_t body);
  void show_surfaces();
  void find_points(const Contact& contact, PenetrationFinder& finder, BodyContact& points) const;
  // How deep the two bodies can be in each other at most, metres.
  double deepest_possible(const BodyContact& contact) const;
  void detect();
  void stop_before_impacts();
  void find_contacts();
  void settle();
  void measure();
  // Calls work(i, threads) for every body: small ones in parallel, large ones one by one on all threads.
  template <class Work>
  void for_each_body(const Work& work);

  DynamicsSettings dynamics_;
  Script script_;
  int threads_;
  std::vector<Body> bodies_;
  std::optional<Recorder> recorder_;  // outlives the world
  World world_;
  std::vector<BodyId> ids_;
  std::vector<std::size_t> small_, large_;           // bodies that can move
  std::vector<std::vector<Vec3>> before_;            // positions at the start of the substep, by body
  std::vector<std::vector<Vec3>> seen_, last_seen_;  // what tact saw in the last step and in that before, by body
  std::vector<double> moved_;                        // the longest way of a vertex between them, by body, metres
  std::vector<PenetrationFinder> finders_;           // one a thread
  std::vector<BodyContact> contacts_;                // of the last detection, and of the one before
  std::vector<BodyContact> last_contacts_;
  ContactSolver solver_;
  ImpactResponse impacts_;
  const Report* report_ = nullptr;
  DynamicsState state_;
  DynamicsTimes times_;
};

}  // namespace tact::scenes
