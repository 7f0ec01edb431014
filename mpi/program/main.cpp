#include <fmt/format.h>
#include <mpi.h>
#include <tact/error.h>
#include <tact/version.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "mpi/program/pile_command.h"
#include "scenes/commands/usage_error.h"
#include "scenes/files/file_error.h"

namespace {

using tact::scenes::FileError;
using tact::scenes::UsageError;

constexpr int kBadInput = 1;
constexpr int kWrongUsage = 2;

// What all ranks know is said once.
int fail(int rank, int status, const std::string& message) {
  if (rank == 0) fmt::print(stderr, "tact-mpi: {}\n", message);
  return status;
}

int fail_usage(int rank, const std::string& message) {
  return fail(rank, kWrongUsage, message + " (see tact-mpi --help)");
}

// What one rank alone knows ends the others, which would wait for it.
[[noreturn]] void abort_all(int rank, const char* message) {
  fmt::print(stderr, "tact-mpi: rank {}: {}\n", rank, message);
  MPI_Abort(MPI_COMM_WORLD, kBadInput);
  std::terminate();
}

int run(int rank, int argc, char** argv) {
  CLI::App program("Scenes over many ranks: started by mpirun.", "tact-mpi");
  program.set_version_flag("--version", "tact-mpi " TACT_VERSION, "Print the version and exit");
  program.footer(
      "Exit status: 0 done; 1 the input is bad, or a file cannot be written; 2 wrong usage.\n"
      "`tact-mpi COMMAND --help` tells about a command.");
  tact::mpi::program::add_pile_command(program, MPI_COMM_WORLD);
  try {
    program.parse(argc, argv);
    return program.get_subcommands().empty() ? fail_usage(rank, "no command") : 0;
  } catch (const CLI::Success& success) {  // --help or --version
    return rank == 0 ? program.exit(success) : 0;
  } catch (const CLI::ParseError& error) {
    return fail_usage(rank, error.what());
  } catch (const UsageError& error) {
    return fail_usage(rank, error.what());
  } catch (const FileError& error) {
    return fail(rank, kBadInput, error.what());
  } catch (const tact::Error& error) {  // the same on all ranks
    if (error.code() == tact::ErrorCode::bad_settings) return fail_usage(rank, error.what());
    return fail(rank, kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    abort_all(rank, "out of memory");
  } catch (const std::exception& error) {
    abort_all(rank, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0, rank = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int status = run(rank, argc, argv);
  if (status == 0 && rank == 0 && !std::cout.flush())
    status = fail(rank, kBadInput, "standard output: cannot be written to its end");
  MPI_Finalize();
  return status;
}
