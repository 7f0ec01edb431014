// The step: stages 2 to 7 over all bodies (stage 1 is Bodies::set_positions, and regroup()).
#pragma once

#include <tact/report.h>
#include <tact/settings.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "broadphase/sweep_and_prune.h"
#include "engine/bodies.h"
#include "engine/pair/pair_table.h"
#include "engine/pair/pair_work.h"
#include "engine/point_stage.h"
#include "engine/self_stage.h"
#include "engine/step_trace.h"

namespace tact {

class Step {
 public:
  // Looks at every pair with a body that changed, and keeps the result of all others. `refresh_ms` is what stage 1
  // took.
  const Report& run(Bodies& bodies, const Settings& settings, double refresh_ms);

  // Groups the facets anew of bodies whose clusters have lost their shape; what pairs remember stays. A part of stage
  // 1, before run(). If it fails, nothing has changed.
  void regroup(Bodies& bodies, int threads);

  // The next step looks at every pair; directions are carried on.
  void look_at_all() { all_ = true; }
  // The next step starts from nothing: after a step that failed half-way. Allocates nothing.
  void forget() noexcept { forgotten_ = true; }

  // Where stage 1 is noted, if Outputs::trace is set.
  StepTrace& trace() { return trace_; }

 private:
  // What a thread did, and its clock.
  struct alignas(64) ThreadTally {
    base::Timer timer;  // runs from pair to pair, once the first has begun
    bool begun = false;
    StepStats stats = {};
  };

  void start_afresh();
  void narrow_phase(Bodies& bodies, const Settings& settings, base::Timer& timer);
  void prefetch_first_bodies(const Bodies& bodies, std::size_t i, std::size_t own_end) const;
  void prefetch_pairs(const Bodies& bodies, std::size_t i, std::size_t own_end) const;
  void put_aside(PairWork& work);
  std::span<const std::unique_ptr<PairWork>> large() const { return std::span(large_).first(large_count_); }
  void count_bodies_and_pairs(const Bodies& bodies);
  void make_report(int threads);
  void update_report(const StepStats& last);
  static void fill(Contact& contact, const PairRecord& record);
  static void fill(Contact& contact, const SelfRecord& record);
  void list_contacts();
  void add_events();
  void keep_report();
  void make_trace(TraceEvent::Time begin, TraceEvent::Time end, const Settings& settings);

  broadphase::SweepAndPrune sweep_;
  PairTable table_;
  std::vector<PairWork> thread_work_;
  std::vector<ThreadTally> tallies_;              // a thread each
  std::vector<std::unique_ptr<PairWork>> large_;  // pairs for all threads; large_count_ of them are in use
  std::size_t large_count_ = 0;
  // A contact of the report: a candidate, or a body with itself.
  struct ReportedContact {
    std::uint32_t place = 0;  // among the candidates
    const SelfRecord* self = nullptr;
  };
  std::vector<ReportedContact> reported_;
  PointStage points_;
  SelfStage self_;
  std::vector<Contact> last_contacts_;  // of the last report, while a new one is made
  narrowphase::EmbreeDevice device_;
  Report report_;
  StepTrace trace_;
  std::int64_t regrouped_ = 0;  // bodies, for the next step, and how long that took
  double regroup_ms_ = 0.0;
  bool all_ = true;
  bool forgotten_ = false;
};

}  // namespace tact
