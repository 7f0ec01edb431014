// A run over time, as a Chrome trace that Perfetto (ui.perfetto.dev) and chrome://tracing open:
//
//   {"displayTimeUnit":"ms","traceEvents":[
//    {"name":"thread_name","ph":"M","pid":1,"tid":0,"args":{"name":"thread 0"}},...
//    {"name":"step 12","cat":"step","ph":"X","ts":200.5,"dur":17.25,"pid":1,"tid":0,"args":{}},...]}
//
// Times are microseconds since the first step began. On thread 0, which drives the others, lie steps; in each the
// phases of the scene and those of the engine; in these its stages. On every thread lie the pairs that it looked at in
// the narrow phase:
//
//   cat    events                                   args
//   step   step 0, step 1, ...
//   scene  motion, contact points, impacts, engine, sleep: stretch by stretch; of the engine the last detection of a
//   step engine detect                                   counts and times, see <tact/statistics.h>; those not 0
//          1 refresh, 2 sweep, 3-6 narrow phase, 7 report
//   pair   "ball#2, bowl": a pair that took long    a, b (names), facet_pairs
//          3 hulls, 4 direction, 5 cull, 6 confirm  a, b; 6 confirm facet_pairs too
//          6 range: a part of 6 confirm of a        a, b, facet_pairs
//            pair so large that all threads share it
//          small pairs: the others between these    pairs
//          separated pairs: those that 18-DOPs separate  pairs
#pragma once

#include <tact/trace.h>

#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "scenes/dynamics/simulation.h"

namespace tact::scenes {

// Writes step by step, so that a long run takes no memory.
class ChromeTrace {
 public:
  // Writes what comes before the steps: `title` names the process. `out` must outlive the trace.
  ChromeTrace(std::ostream& out, const std::string& title, int threads);
  // The settings of the simulation must ask for Outputs::trace.
  void add_step(int step, const Simulation& simulation);
  // Writes what comes after the steps.
  void finish();

 private:
  using Time = TraceEvent::Time;
  struct Event {
    std::string name;
    std::string_view category;
    int thread = 0;
    Time begin, end;
    std::string args = "{}";  // JSON
  };
  void write_name(std::string_view what, int thread, const std::string& name);
  void write(const Event& event);
  void add_phases(int step, const DynamicsTimes& times);
  void add_engine_event(const TraceEvent& event, const Simulation& simulation);
  double microseconds(Time::duration duration) const;

  std::ostream& out_;
  std::optional<Time> start_;  // of the first step
  bool first_ = true;
};

}  // namespace tact::scenes
