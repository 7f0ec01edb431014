#include "engine/base/thread_pool.h"

#include <algorithm>
#include <new>
#include <system_error>

namespace tact::base {

// It is never destroyed: worlds may be used until the program's very end.
ThreadPool& ThreadPool::shared() {
  static ThreadPool* const pool = new ThreadPool;
  return *pool;
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wanted_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::make_threads(int count) noexcept {
  try {
    while (threads_.size() < static_cast<std::size_t>(count)) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
}

void ThreadPool::run(int count, const Task& task) noexcept {
  std::unique_lock lock(mutex_);
  make_threads(count - 1);
  Call call{task, 0, count};
  bool shared = count > 1;
  try {
    if (shared) calls_.push_back(&call);
  } catch (const std::bad_alloc&) {
    shared = false;
  }
  if (shared) wanted_.notify_all();
  while (call.next < call.count) {
    if (shared && call.next + 1 == call.count) calls_.erase(std::ranges::find(calls_, &call));
    take_one(call, lock);
  }
  done_.wait(lock, [&] { return call.running == 0; });
}

// Called with the lock, which is open while the task runs.
void ThreadPool::take_one(Call& call, std::unique_lock<std::mutex>& lock) {
  const int index = call.next++;
  ++call.running;
  lock.unlock();
  call.task(index);
  lock.lock();
  if (--call.running == 0) done_.notify_all();
}

void ThreadPool::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wanted_.wait(lock, [&] { return ends_ || !calls_.empty(); });
    if (ends_) return;
    Call& call = *calls_.front();
    if (call.next + 1 == call.count) calls_.erase(calls_.begin());
    take_one(call, lock);
  }
}

}  // namespace tact::base
