// Threads of a program that do the work of a world.
#pragma once

#include <tact/error.h>

namespace tact {

/// Runs the tasks of a world on threads of the program: a job system, a pool, an arena. Settings::executor takes it.
/// The answers are the same bits on any threads.
class TACT_API Executor {
 public:
  /// The work that the workers share: each takes parts of it until nothing is left.
  class Task {
   public:
    using Function = void (*)(void* data, int index);
    Task(Function function, void* data) : function_(function), data_(data) {}
    /// Runs the worker `index`, the number of the thread in Report::trace().
    void operator()(int index) const noexcept { function_(data_, index); }

   private:
    Function function_;
    void* data_;
  };

  virtual ~Executor();

  /// Calls `task(index)` once for each 0 <= index < count, on any threads, and returns when all calls have returned.
  /// The calling thread should take indices too, from 0 on. It also does those that were left out.
  virtual void run(int count, const Task& task) noexcept = 0;
};

}  // namespace tact
