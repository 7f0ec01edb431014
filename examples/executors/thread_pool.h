// A pool of std::thread as the threads of tact's worlds: the smallest job system that does it right.
#pragma once

#include <tact/executor.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

class ThreadPool : public tact::Executor {
 public:
  // Starts `count` threads. With the one that calls run(), there are count + 1.
  explicit ThreadPool(int count) {
    for (int k = 0; k < count; ++k) threads_.emplace_back([this] { serve(); });
  }

  ~ThreadPool() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wakes_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  // The caller takes indices like any other thread. When none is left it waits for those that are running, and for
  // nobody who has yet to wake up. One call at a time: a pool for each thread that steps worlds.
  void run(int count, const Task& task) noexcept override {
    std::unique_lock lock(mutex_);
    task_ = &task;
    next_ = 0;
    count_ = count;
    lock.unlock();
    for (int k = 1; k < count; ++k) wakes_.notify_one();
    lock.lock();
    while (take(lock)) {
    }
    ended_.wait(lock, [&] { return running_ == 0; });
    task_ = nullptr;
  }

 private:
  // Does one index, if one is left. `lock` is held before and after, not while the task runs.
  bool take(std::unique_lock<std::mutex>& lock) {
    if (next_ >= count_) return false;
    const Task& task = *task_;
    const int index = next_++;
    ++running_;
    lock.unlock();
    task(index);
    lock.lock();
    if (--running_ == 0) ended_.notify_one();
    return true;
  }

  void serve() {
    std::unique_lock lock(mutex_);
    while (!ends_) {
      if (!take(lock)) wakes_.wait(lock);
    }
  }

  std::mutex mutex_;
  std::condition_variable wakes_, ended_;
  const Task* task_ = nullptr;
  int next_ = 0, count_ = 0, running_ = 0;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};
