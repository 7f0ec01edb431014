// How a program's own threads do the work of a world.
#pragma once

#include <tact/error.h>

namespace tact {

/// Runs the tasks of a world on threads of the program that it is a part of: a job system, a pool, an arena. Derive
/// from it and give it to Settings::executor. The answers are the same bits whichever threads do the work.
class TACT_API Executor {
 public:
  /// One of a few equal workers: it takes what there is to do, bit by bit, until nothing is left. Never throws.
  class Task {
   public:
    using Function = void (*)(void* data, int index);
    Task(Function function, void* data) : function_(function), data_(data) {}
    /// Calls the worker `index`, which is also the number of the thread in Report::trace().
    void operator()(int index) const noexcept { function_(data_, index); }

   private:
    Function function_;
    void* data_;
  };

  virtual ~Executor();

  /// Calls `task(index)` once for each 0 <= index < count, on any threads, at the same time or one after the other, and
  /// returns when all these calls have returned. `task` is gone then. `count` is Settings::threads at most.
  ///
  /// The calling thread should take indices as well, from 0 on: what is left when it is done has nothing to do any
  /// more, so that it waits for no thread that has not begun. Indices that are left out are done by the calling thread,
  /// one that is called again does nothing.
  virtual void run(int count, const Task& task) noexcept = 0;
};

}  // namespace tact
