// The step: stages 2 to 7 over all bodies (stage 1 is Bodies::set_positions, and regroup()).
#pragma once

#include <tact/report.h>
#include <tact/settings.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "broadphase/sweep_and_prune.h"
#include "engine/base/timer.h"
#include "engine/bodies/bodies.h"
#include "engine/bodies/plane_pairs.h"
#include "engine/containment.h"
#include "engine/curve_stage.h"
#include "engine/pair/pair_table.h"
#include "engine/pair_stage.h"
#include "engine/patch_stage.h"
#include "engine/point_stage.h"
#include "engine/reach_stage.h"
#include "engine/renumbering.h"
#include "engine/report_writer.h"
#include "engine/self_stage.h"
#include "engine/step_trace.h"

namespace tact {

class Step {
  friend struct StateFields;

 public:
  /// Looks at every pair with a body that changed, and keeps the result of all others. `refresh_ms` is what stage 1
  /// took, milliseconds. If it throws, forget() is to be called; the bodies have changed as they had before.
  const Report& run(Bodies& bodies, const Settings& settings, double refresh_ms);
  /// Of the last run(); if that failed at its end, what it found.
  const Report& last_report() const { return writer_.report(); }

  /// Groups the facets again of bodies whose clusters have lost their shape; what pairs remember stays. A part of stage
  /// 1, before run(). If it fails, nothing has changed.
  void regroup(Bodies& bodies, int threads);

  /// What is remembered of a body whose facets change, by the new numbers of its vertices; and puts that in its place.
  Renumbering renumbering_of(const Bodies::VertexChange& change);
  void renumber(const Bodies::VertexChange& change, Renumbering&& renumbering) noexcept;

  /// The next step looks at every pair; directions are carried on.
  void look_at_all() { all_ = true; }
  /// The next step starts from nothing: after a step that failed half-way. Allocates nothing.
  void forget() noexcept {
    forgotten_ = true;
    discarded_ = false;
  }
  /// The next run() throws Discarded when all is found.
  void discard() { discarded_ = true; }
  struct Discarded {};
  /// Called by each run() when all is found, before anything of it counts. If it throws, the step fails.
  void set_commit(std::function<void(const Report&)> commit) { commit_ = std::move(commit); }

  /// What World::restore() puts in the place of what was found of the last step. The next step goes on from there.
  struct Restored;
  void restore(Restored&& restored) noexcept;

  /// Where stage 1 is noted, if Outputs::trace is set.
  StepTrace& trace() { return trace_; }

 private:
  /// What is found of a step, and what the next one starts from. A step that fails may leave any of it half-way: all
  /// of it is made anew. What stands beside it is complete between any two statements of run().
  struct Stages {
    broadphase::SweepAndPrune sweep;
    PlanePairs planes;
    PairTable table;
    PairStage pairs;
    ContainmentStage containment;
    PointStage points;
    SelfStage selves;
    CurveStage curves;
    ReachStage within_reach;
    PatchStage patches;
    bool knows_boxes = true;  // whether the sweep does, but for those that changed: not after restore()
  };
  void start_from_scratch();
  void keep_last_answers();
  void look_at_what_moved(Bodies& bodies, const Settings& settings, base::Timer& timer, StepStats& stats);
  void find_curves(const Bodies& bodies, const Settings& settings);
  void find_patches(PatchStage& patches, const Bodies& bodies, const Settings& settings);
  void make_trace(TraceEvent::Time begin, TraceEvent::Time end, const Settings& settings);

  std::unique_ptr<Stages> stages_ = std::make_unique<Stages>();
  ReportWriter writer_;  // keeps its place: a caller has the report; forget() makes the rest of it anew
  StepTrace trace_;
  narrowphase::EmbreeDevice device_;
  std::int64_t regrouped_ = 0;  // bodies, for the next step, and how long that took
  double regroup_ms_ = 0.0;
  bool all_ = true;
  bool forgotten_ = false, discarded_ = false;
  bool altered_ = false;  // bodies or pairs came or went that did not move
  std::function<void(const Report&)> commit_;
};

struct Step::Restored {
  std::unique_ptr<Stages> stages = std::make_unique<Stages>();
  ReportWriter writer;
  bool all = true;
};

}  // namespace tact
