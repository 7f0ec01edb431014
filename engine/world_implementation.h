// What a world holds, for its functions alone: world.cpp, and world_queries.cpp with the queries.
#pragma once

#include <tact/world.h>

#include <memory>
#include <new>

#include "engine/base/pool.h"
#include "engine/base/timer.h"
#include "engine/bodies/bodies.h"
#include "engine/motion_stage.h"
#include "engine/ray_trees.h"
#include "engine/step.h"
#include "engine/with_memory.h"

namespace tact {

struct World::Implementation {
  explicit Implementation(const Settings& given);

  Settings settings;
  base::Tuning tuning;  // the bodies refer to it
  base::Workers workers;
  Bodies bodies;
  Step step;
  base::Pool<RayTrees> ray_trees;
  std::unique_ptr<MotionStage> motion = nullptr;  // made by the first detect_motion()
  double refresh_ms = 0.0;                        // since the last step
  WorldObserver* observer = nullptr;

  // Calls tell(observer), if there is one.
  template <class Tell>
  void observe(const Tell& tell) {
    if (observer != nullptr) tell(*observer);
  }

  // Calls work(), which is part of stage 1, and takes its time.
  template <class Work>
  void refresh(const Work& work) {
    base::Timer timer;
    const auto begin = timer.start();
    if (settings.outputs.trace) step.trace().make_room();
    work();
    refresh_ms += timer.lap();
    if (settings.outputs.trace) step.trace().add_refresh(begin, timer.start());
  }

  // Before anything changes but positions and poses.
  void forget_ways() {  // NOLINT: not const, as what `motion` holds changes
    if (motion != nullptr) motion->forget_ways();
  }

  // Calls change(), and tell(observer) once it has succeeded.
  template <class Change, class Tell>
  void change(const Change& change, const Tell& tell) {
    const base::FloatingPointMode mode;
    forget_ways();
    with_memory(change);
    observe(tell);
  }

  template <class Set>
  void set_positions(const Set& set) {
    const base::Workers::Scope scope(workers);
    with_memory("setting positions ran out of memory", [&] { refresh(set); });
  }

  // Where memory is short bodies stay grouped as they are: that is slower, and nothing else.
  void regroup() {
    if (!bodies.any_decayed()) return;
    try {
      refresh([&] { step.regroup(bodies, settings.threads); });
    } catch (const std::bad_alloc&) {
      bodies.keep_groups();
    }
  }

  const Report& detect() {
    forget_ways();
    observe([](WorldObserver& told) { told.step_begins(); });
    try {
      return with_memory("detect ran out of memory; the next call starts from scratch", [&]() -> const Report& {
        const base::Workers::Scope scope(workers);
        regroup();
        const Report& report = step.run(bodies, settings, refresh_ms);
        refresh_ms = 0.0;
        return report;
      });
    } catch (...) {
      step.forget();
      bodies.mark_all_changed();
      observe([](WorldObserver& told) { told.step_failed(); });
      throw;
    }
  }
};

}  // namespace tact
