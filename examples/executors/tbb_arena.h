// An arena of TBB as the threads of tact's worlds.
#pragma once

#include <tact/executor.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

class TbbArena : public tact::Executor {
 public:
  // `threads` threads, the one that calls run() among them.
  explicit TbbArena(int threads) : arena_(threads) {}

  void run(int count, const Task& task) noexcept override {
    arena_.execute([&] { tbb::parallel_for(0, count, task, tbb::simple_partitioner()); });
  }

 private:
  tbb::task_arena arena_;
};
