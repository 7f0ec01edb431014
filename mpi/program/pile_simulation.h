// A pile of soft bodies over many ranks. It ends with the same bits on any number of them.
#pragma once

#include <mpi.h>
#include <tact/mpi/world.h>

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "mpi/program/rank_contacts.h"
#include "scenes/dynamics/body.h"
#include "scenes/dynamics/dynamics_settings.h"
#include "scenes/dynamics/sleep.h"
#include "scenes/library/pile.h"

namespace tact::mpi::program {

struct PileOptions {
  int size = 300;  // bodies
  Settings settings = {};
};

// How a step went, over all ranks. Sums of what is no integer are made of integers, which add up in any order.
struct PileState {
  double time = 0.0;            // seconds simulated
  double kinetic_energy = 0.0;  // joules, each body's rounded to 2^-30
  std::int64_t awake = 0, asleep = 0;
  std::int64_t contacts = 0, contact_points = 0;                  // of the last detection
  std::int64_t facet_pairs = 0;                                   // that cross, likewise
  std::int64_t detections = 0;                                    // in this step
  double smallest_gap = std::numeric_limits<double>::infinity();  // of a contact point, metres
};

// Keys of the bodies are 0 to size - 1, those of floor and walls, which every rank holds, come after them. All ranks
// call every function together, but those that are const.
class PileSimulation {
 public:
  // Errors: those of World.
  PileSimulation(MPI_Comm communicator, const PileOptions& options);
  PileSimulation(const PileSimulation&) = delete;  // the world calls it back
  PileSimulation& operator=(const PileSimulation&) = delete;

  void step();

  const PileState& state() const { return state_; }
  // The bodies of this rank in the order of their keys; floor and walls are left out.
  std::span<const Body> bodies() const { return std::span(bodies_).first(keys_.size()); }
  std::span<const std::uint64_t> keys() const { return keys_; }
  // Of the last detection.
  const Report& report() const { return *report_; }
  // Of all detections of the last step, on this rank; what is no sum is of the last one.
  const Statistics& stats() const { return stats_; }
  const World& world() const { return world_; }

 private:
  // What else is known of a body of this rank.
  struct Progress {
    scenes::Rest rest = {};
    double reach = 0.0;     // metres
    double last_way = 0.0;  // in the last substep, metres
    double way = 0.0;       // since the last detection, metres
    double free = 0.0;      // how far it may go until the next one, metres
  };
  struct Arrived {
    Body body;
    Progress progress;
  };

  Body make_body(std::uint64_t key) const;
  std::vector<std::byte> pack(std::uint64_t key) const;
  void unpack(std::uint64_t key, std::span<const std::byte> bytes);
  void move_in_and_out();
  std::size_t index_of(std::uint64_t key) const;
  int place_of(std::uint64_t key) const;

  void run_substep(double h);
  bool has_left_its_reach(double h) const;
  void detect();
  void take_contacts();
  void limit_ways();
  void rest();
  void measure();
  template <class Work>
  void for_each_body(const Work& work);

  MPI_Comm communicator_;
  int size_;
  scenes::PileGrid grid_;
  scenes::DynamicsSettings dynamics_;
  World world_;
  int threads_;
  std::vector<std::uint64_t> keys_;           // of the bodies of this rank, ascending
  std::vector<Body> bodies_;                  // in their order, then floor and walls
  std::vector<Progress> progress_;            // by body, without floor and walls
  std::vector<std::vector<Vec3>> before_;     // by body: positions when the substep began
  std::map<std::uint64_t, Arrived> arrived_;  // since bodies_ was made
  std::vector<std::uint64_t> gone_;
  RankContacts contacts_;
  const Report* report_ = nullptr;
  Statistics stats_;
  PileState state_;
};

}  // namespace tact::mpi::program
