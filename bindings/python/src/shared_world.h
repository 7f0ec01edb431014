// A world as Python holds it: it is used by one thread at a time, and knows which of its reports is the last.
#pragma once

#include <pybind11/pybind11.h>
#include <tact/kept_report.h>
#include <tact/recording.h>
#include <tact/world.h>

#include <cstdint>
#include <exception>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "interpreter.h"

namespace tact::python {

namespace py = pybind11;

/// Becomes tact.StaleReportError: a report, or a part of it, was used after its step.
class StaleReport : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that a world is recorded to.
struct FileRecording {
  explicit FileRecording(const std::string& path) : file(path, std::ios::binary), recorder(file) {}
  std::ofstream file;
  Recorder recorder;
};

/// Every member is read and written by threads that hold the interpreter's lock, but for the world inside compute() and
/// ask().
class SharedWorld : public std::enable_shared_from_this<SharedWorld> {
 public:
  explicit SharedWorld(const Settings& settings) : SharedWorld(std::make_shared<World>(settings)) {}
  explicit SharedWorld(std::shared_ptr<World> world) : world_(std::move(world)) {}
  /// Of a copy of a report, which stays: it stands in a world of no bodies.
  static std::shared_ptr<SharedWorld> for_copy() {
    const auto shared = std::make_shared<SharedWorld>(Settings{.threads = 1});
    shared->kept_.emplace();
    return shared;
  }
  /// Copies another report; what was read of the last copy is stale. @throws Error wrong_order while another call reads
  /// or changes it, or if it holds no copy.
  const Report& keep(const Report& report) {
    check_is_copy();
    use();
    next_report();
    const Busy busy(*this);
    without_lock([&] { kept_->keep(report); });
    return kept_->report();
  }
  void check_is_copy() const {
    if (!kept_) throw Error(ErrorCode::wrong_order, "`into` is a report of a world, not one that was kept");
  }
  std::uint64_t last_report() const { return report_; }

  /// While it lives, the world can be read and not changed: whatever Python runs meanwhile, a drawer, a finalizer,
  /// another thread, what is read stays. @throws Error wrong_order while the world is changed.
  class Reading {
   public:
    explicit Reading(SharedWorld& shared) : shared_(shared) {
      shared.read();
      ++shared_.readers_;
    }
    ~Reading() { --shared_.readers_; }
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    SharedWorld& shared_;
  };

  /// The world, for a call that keeps the lock and runs no Python. @throws Error wrong_order while another call uses
  /// it.
  World& use() {
    if (busy_ || readers_ > 0) throw in_use();
    return *world_;
  }
  /// The same for a call that only reads. @throws Error wrong_order while another call changes it.
  const World& read() const {
    if (busy_) throw in_use();
    return *world_;
  }
  /// Calls work(world) without the lock, so that other threads of Python go on.
  template <class Work>
  void compute(const Work& work) {
    World& world = use();
    const Busy busy(*this);
    without_lock([&] { work(world); });
  }
  /// The same for work that only reads: other threads can read, too.
  template <class Work>
  void ask(const Work& work) {
    const Reading reading(*this);
    without_lock([&] { work(std::as_const(*world_)); });
  }
  /// The report of the step that is made now; those of before are stale from here on.
  std::uint64_t next_report() { return ++report_; }
  /// @throws StaleReport if it is not the last, Error wrong_order as read().
  void check_report(std::uint64_t report) const {
    read();
    if (report != report_)
      throw StaleReport(
          "this report is of an earlier step: what it shows is gone with the next detect(), set_settings() or "
          "restore()");
  }

  /// Records the world to a file from now on, or no more.
  /// @throws OSError if the file cannot be written, Error wrong_order as World::set_observer().
  void record(const std::string& path);
  void stop_recording();

 private:
  static Error in_use() {
    return {ErrorCode::wrong_order, "the world is in use by another thread, or by the call that this one comes from"};
  }

  template <class Work>
  static void without_lock(const Work& work) {
    std::exception_ptr thrown;
    PyThreadState* const thread = PyEval_SaveThread();
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
    waiting_at_exit([&] { PyEval_RestoreThread(thread); });
    if (thrown) std::rethrow_exception(thrown);
  }

  struct Busy {
    explicit Busy(SharedWorld& shared) : shared_(shared) { shared_.busy_ = true; }
    ~Busy() { shared_.busy_ = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    SharedWorld& shared_;
  };

  std::unique_ptr<FileRecording> recording_;  // outlives the world
  std::shared_ptr<World> world_;
  std::optional<KeptReport> kept_;
  std::uint64_t report_ = 0;
  bool busy_ = false;
  int readers_ = 0;
};

/// A report, or something in it, that is used only while it is the world's last.
template <class Shown>
class OfReport {
 public:
  OfReport(std::shared_ptr<SharedWorld> world, std::uint64_t report, const Shown* shown)
      : world_(std::move(world)), report_(report), shown_(shown) {}

  /// What is shown, and stays while this lives.
  class Held {
   public:
    explicit Held(const OfReport& shown) : reading_(*shown.world_), shown_(shown.shown_) {}
    const Shown& operator*() const { return *shown_; }
    const Shown* operator->() const { return shown_; }

   private:
    SharedWorld::Reading reading_;
    const Shown* shown_;
  };
  /// @throws StaleReport, Error wrong_order.
  Held held() const {
    world_->check_report(report_);
    return Held(*this);
  }
  /// The same for one expression.
  Held operator->() const { return held(); }
  const std::shared_ptr<SharedWorld>& world() const { return world_; }
  /// Something else in the same report.
  template <class Part>
  OfReport<Part> part(const Part& part) const {
    return {world_, report_, &part};
  }

 private:
  std::shared_ptr<SharedWorld> world_;
  std::uint64_t report_;
  const Shown* shown_;
};

}  // namespace tact::python
