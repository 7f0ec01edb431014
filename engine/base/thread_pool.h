// Threads of our own, for a build without OpenMP (TACT_WITH_OPENMP).
#pragma once

#include <tact/executor.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace tact::base {

// A thread is made when a call first wants it, and lasts. Several threads may call run() at once.
class ThreadPool final : public Executor {
 public:
  // That of all worlds.
  static ThreadPool& shared();

  ThreadPool() = default;
  ~ThreadPool() override;
  // Where no more threads are to be had, those that are there do the work, the calling thread among them.
  void run(int count, const Task& task) noexcept override;

 private:
  struct Call {
    const Task& task;
    int next, count;  // the index to be given out next
    int running = 0;
  };

  void work();
  void take_one(Call& call, std::unique_lock<std::mutex>& lock);
  void make_threads(int count) noexcept;

  std::mutex mutex_;
  std::condition_variable wanted_, done_;
  std::vector<Call*> calls_;  // with indices that nobody has taken
  std::vector<std::thread> threads_;
  bool ends_ = false;
};

}  // namespace tact::base
