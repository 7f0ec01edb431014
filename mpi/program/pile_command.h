// `tact-mpi pile`: a pile of soft bodies over the ranks that mpirun started.
#pragma once

#include <mpi.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>

#include "mpi/program/pile_simulation.h"

namespace tact::mpi::program {

struct PileCommand {
  PileOptions pile;
  int frames = 300;        // steps of the simulation
  int every = 4;           // steps from one frame of the file to the next
  bool positions = false;  // in each frame of the file, not in its last one alone
  std::string out = {};    // states and contacts; empty: none
  std::string json = {};   // what the run added up to, "-" for standard output; empty: none
};

// Runs the pile and prints, on rank 0 alone. All ranks call it together. Errors: UsageError, FileError, Error.
void run_pile(MPI_Comm communicator, const PileCommand& command);

// Adds the subcommand `pile` to `program`; to parse it is to run it.
void add_pile_command(CLI::App& program, MPI_Comm communicator);

}  // namespace tact::mpi::program
