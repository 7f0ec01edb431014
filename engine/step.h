// The step: stages 2 to 7 over all bodies (stage 1 is Bodies::set_positions).
#pragma once

#include <tact/report.h>
#include <tact/settings.h>

#include <memory>
#include <span>
#include <vector>

#include "broadphase/sweep_and_prune.h"
#include "engine/bodies.h"
#include "engine/pair_record.h"
#include "engine/pair_work.h"
#include "engine/step_trace.h"

namespace tact {

class Step {
 public:
  // Looks at every pair with a body that changed, and keeps the result of all others. `refresh_ms` is what stage 1
  // took.
  const Report& run(Bodies& bodies, const Settings& settings, double refresh_ms);

  // The next step looks at every pair; directions are carried on.
  void look_at_all() { all_ = true; }
  // The next step starts from nothing: after a step that failed half-way. Allocates nothing.
  void forget() noexcept { forgotten_ = true; }

  // Where stage 1 is noted, if Outputs::trace is set.
  StepTrace& trace() { return trace_; }

 private:
  void start_afresh();
  void note_touches();
  void match_records(const Bodies& bodies);
  void select_moved(const Bodies& bodies);
  void narrow_phase(const Bodies& bodies, const Settings& settings);
  void prefetch_pairs(const Bodies& bodies, std::size_t i, std::size_t own_end) const;
  void put_aside(PairWork& work);
  std::span<const std::unique_ptr<PairWork>> large() const { return std::span(large_).first(large_count_); }
  void count_work(const Bodies& bodies, const Settings& settings);
  void make_report();
  void update_report(const StepStats& last);
  bool same_contacts() const;
  static void fill(Contact& contact, const PairRecord& record);
  void add_events();
  void add_work(const PairRecord& record, const Settings& settings);
  void keep_report();
  void finish(base::Timer& total, const Settings& settings, double refresh_ms);
  PairRecord& new_record(BodyId a, BodyId b);
  void retire(PairRecord& record);

  broadphase::SweepAndPrune sweep_;
  std::vector<std::unique_ptr<PairRecord>> pool_;
  std::vector<PairRecord*> free_;
  std::size_t room_ = 0;                      // facet pairs that a record has room for when it is given out
  std::vector<PairRecord*> records_;          // of the candidate pairs, sorted by (a, b)
  std::vector<broadphase::IndexPair> pairs_;  // their slots
  std::vector<PairRecord*> previous_;         // those of the last step, while matching
  std::vector<PairRecord*> moved_;            // those that this step looks at
  std::vector<PairWork> thread_work_;
  std::vector<std::unique_ptr<PairWork>> large_;  // pairs for all threads; large_count_ of them are in use
  std::size_t large_count_ = 0;
  std::vector<ContactEvent> gone_;  // pairs that touched and are no candidates any more
  narrowphase::EmbreeDevice device_;
  Report report_;
  StepTrace trace_;
  bool all_ = true;
  bool forgotten_ = false;
};

}  // namespace tact
