// A world over many ranks as Python holds it, and what of its last report is shown.
#pragma once

#include <pybind11/pybind11.h>
#include <tact/mpi/world.h>

#include <cstdint>
#include <memory>
#include <thread>
#include <utility>

#include "../src/shared_world.h"

namespace tact::python {

/// For one thread: MPI is initialized for no more.
class RankWorld : public std::enable_shared_from_this<RankWorld> {
 public:
  RankWorld(MPI_Comm communicator, const mpi::Settings& settings) : world_(communicator, settings) {}

  /// @throws Error wrong_order inside a function that the world calls.
  mpi::World& use() {
    if (busy_) throw Error(ErrorCode::wrong_order, "the world is in the call that this one comes from");
    return world_;
  }
  /// @throws Error wrong_order while another thread is in a call of ranks together.
  const mpi::World& read() const {
    if (busy_ && thread_ != std::this_thread::get_id())
      throw Error(ErrorCode::wrong_order, "another thread is in a call of the world");
    return world_;
  }
  /// Calls work(world), in which ranks wait for each other, without the interpreter's lock.
  template <class Work>
  void together(const Work& work) {
    mpi::World& world = use();
    ++step_;
    struct Busy {
      explicit Busy(bool& busy) : busy_(busy) { busy_ = true; }
      ~Busy() { busy_ = false; }
      bool& busy_;
    } const busy(busy_);
    thread_ = std::this_thread::get_id();
    const py::gil_scoped_release released;
    work(world);
  }

  std::uint64_t step() const { return step_; }
  /// @throws StaleReport if a call together came since.
  void check(std::uint64_t step) const {
    if (step != step_) throw StaleReport("this report is of an earlier step: what it shows is gone");
  }

 private:
  mpi::World world_;
  std::uint64_t step_ = 0;
  bool busy_ = false;
  std::thread::id thread_;  // that is in the call, if busy
};

/// A report, or something in it, that is used only while it is the world's last.
template <class Shown>
class OfStep {
 public:
  OfStep(std::shared_ptr<RankWorld> world, const Shown& shown)
      : world_(std::move(world)), step_(world_->step()), shown_(&shown) {}
  const Shown& operator*() const {
    world_->check(step_);
    return *shown_;
  }
  const Shown* operator->() const { return &**this; }
  template <class Part>
  OfStep<Part> part(const Part& part) const {
    return {world_, part};
  }

 private:
  std::shared_ptr<RankWorld> world_;
  std::uint64_t step_;
  const Shown* shown_;
};

void define_report(py::module_& module);
void define_world(py::module_& module);

}  // namespace tact::python
