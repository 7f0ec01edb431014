#include "mpi/program/pile_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <sys/resource.h>
#include <tact/version.h>

#include <CLI/Validators.hpp>
#include <chrono>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mpi/program/ordered_file.h"
#include "mpi/program/pile_file.h"
#include "scenes/commands/common_options.h"
#include "scenes/commands/json_text.h"
#include "scenes/commands/usage_error.h"
#include "scenes/files/output_file.h"

namespace tact::mpi::program {
namespace {

using scenes::Json;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// The most memory that this process had, megabytes.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// What the steps so far added up to, on this rank.
struct RankTotals {
  Statistics sums;  // what is no sum is of the last step
  double most_imbalance = 1.0;
};

void add(const Statistics& step, RankTotals& totals) {
  const Statistics before = totals.sums;
  totals.sums = step;
  for (const auto member : {&Statistics::messages, &Statistics::bytes, &Statistics::moved_bodies})
    totals.sums.*member += before.*member;
  totals.most_imbalance = std::max(totals.most_imbalance, step.imbalance);
}

// A row a rank, the same columns on each; on rank 0 those of all.
std::vector<std::vector<double>> gather(const std::vector<double>& row, MPI_Comm communicator) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  std::vector<double> all(rank == 0 ? row.size() * static_cast<std::size_t>(ranks) : 0);
  const int count = static_cast<int>(row.size());
  MPI_Gather(row.data(), count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE, 0, communicator);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < all.size(); i += row.size())
    rows.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(i),
                      all.begin() + static_cast<std::ptrdiff_t>(i + row.size()));
  return rows;
}

constexpr std::array kColumns{"bodies", "ghosts", "pairs", "messages", "bytes", "moved bodies", "peak MB"};

std::vector<std::vector<double>> rank_rows(const RankTotals& totals, int steps, MPI_Comm communicator) {
  const auto per_step = [&](std::int64_t sum) { return static_cast<double>(sum) / std::max(steps, 1); };
  const Statistics& s = totals.sums;
  return gather({static_cast<double>(s.own_bodies), static_cast<double>(s.ghosts), static_cast<double>(s.pairs),
                 per_step(s.messages), per_step(s.bytes), static_cast<double>(s.moved_bodies), peak_memory()},
                communicator);
}

void print_table(std::ostream& out, const std::vector<std::vector<double>>& rows) {
  fmt::print(out, "\nmessages and bytes are a step's\nrank");
  for (const char* const column : kColumns) fmt::print(out, "{:>14}", column);
  for (std::size_t rank = 0; rank < rows.size(); ++rank) {
    fmt::print(out, "\n{:4}", rank);
    for (const double value : rows[rank]) fmt::print(out, "{:14.0f}", value);
  }
  fmt::print(out, "\n");
}

Json summary_json(const PileCommand& command, const PileState& state, const std::vector<std::vector<double>>& rows,
                  double seconds) {
  Json ranks = Json::array();
  for (const std::vector<double>& row : rows) {
    Json& rank = ranks.emplace_back(Json::object());
    for (std::size_t k = 0; k < row.size(); ++k) rank[kColumns[k]] = row[k];
  }
  return {{"tact", TACT_VERSION},
          {"size", command.pile.size},
          {"frames", command.frames},
          {"seconds", seconds},
          {"kinetic_energy", state.kinetic_energy},
          {"asleep", state.asleep},
          {"contacts", state.contacts},
          {"contact_points", state.contact_points},
          {"facet_pairs", state.facet_pairs},
          {"ranks", std::move(ranks)}};
}

// A line now and then, so that a long run is seen to go on.
class Progress {
 public:
  Progress(std::ostream& out, int frames) : out_(out), frames_(frames) {
    fmt::print(out_, "{:>6} {:>9} {:>10} {:>8} {:>8} {:>9} {:>7} {:>9} {:>10}\n", "frame", "time s", "energy J",
               "asleep", "contacts", "points", "crossed", "imbalance", "ms a frame");
  }
  void show(int frame, const PileState& state, double imbalance) {
    if (frame != frames_ && frame * kLines / frames_ == (frame - 1) * kLines / frames_) return;
    const double ms = 1e3 * seconds_since(last_) / (frame - last_frame_);
    fmt::print(out_, "{:6} {:9.4f} {:10.4g} {:8} {:8} {:9} {:7} {:9.2f} {:10.1f}\n", frame, state.time,
               state.kinetic_energy, state.asleep, state.contacts, state.contact_points, state.facet_pairs, imbalance,
               ms);
    out_.flush();
    last_ = Clock::now();
    last_frame_ = frame;
  }

 private:
  static constexpr std::int64_t kLines = 20;
  std::ostream& out_;
  int frames_;
  Clock::time_point last_ = Clock::now();
  int last_frame_ = 0;
};

}  // namespace

void run_pile(MPI_Comm communicator, const PileCommand& command) {
  const Clock::time_point start = Clock::now();
  if (command.out == "-") throw scenes::UsageError("--out: all ranks write to one file, not to standard output");
  if (!command.out.empty() && command.out == command.json)
    throw scenes::UsageError("--out and --json: both would go to one file");
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  std::optional<OrderedFile> file;
  if (!command.out.empty()) file.emplace(communicator, command.out, command.pile.size);
  PileSimulation pile(communicator, command.pile);
  const bool prints = rank == 0 && command.json != "-";
  std::optional<Progress> progress;
  if (prints) progress.emplace(std::cout, command.frames);
  RankTotals totals;
  for (int frame = 1; frame <= command.frames; ++frame) {
    pile.step();
    add(pile.stats(), totals);
    const bool last = frame == command.frames;
    if (file && (last || frame % command.every == 0))
      append_frame(*file, frame, pile, last || command.positions ? Vertices::written : Vertices::left_out);
    if (progress) progress->show(frame, pile.state(), pile.stats().imbalance);
  }
  if (file) file->finish();
  const auto rows = rank_rows(totals, command.frames, communicator);
  if (prints) print_table(std::cout, rows);
  if (rank != 0 || command.json.empty()) return;
  scenes::OutputFile json(command.json, std::cout);
  json.stream() << scenes::json_text(summary_json(command, pile.state(), rows, seconds_since(start))) << '\n';
  json.finish();
}

void add_pile_command(CLI::App& program, MPI_Comm communicator) {
  CLI::App* command = program.add_subcommand("pile", "Soft bodies fall into a bin, each on the rank that owns it");
  const auto options = std::make_shared<PileCommand>();
  options->pile.settings.rebalance_above = 1.2;
  options->pile.settings.world.threads = 1;
  const auto positive = [] { return CLI::Range(1, std::numeric_limits<int>::max()).description(""); };
  command->footer("Example:\n  mpirun -n 4 tact-mpi pile --size 10000 --frames 200 --out pile.jsonl");
  command->add_option("--size", options->pile.size, "How many bodies; 300 if not given")
      ->type_name("N")
      ->check(positive());
  command->add_option("--frames", options->frames, "How many steps; 300 if not given")
      ->type_name("N")
      ->check(positive());
  command->add_option("--threads", options->pile.settings.world.threads, "Threads of each rank; 1 if not given")
      ->type_name("N")
      ->check(CLI::Range(0, 1024).description(""));
  command
      ->add_option(
          "--out", options->out,
          "Write states and contacts of all ranks to this file, as JSON, the same bytes for any number of ranks")
      ->type_name("FILE")
      ->check(scenes::refuse_empty_name);
  command->add_option("--every", options->every, "Steps from one frame of that file to the next; 4 if not given")
      ->type_name("N")
      ->check(positive());
  command->add_flag("--positions", options->positions, "Write all vertices in every frame, not in the last one alone");
  scenes::add_json_option(*command, options->json);
  command
      ->add_option("--rebalance", options->pile.settings.rebalance_above,
                   "Share bodies out anew when the busiest rank has so many times the mean to do; 0: never")
      ->type_name("X")
      ->check(CLI::Range(0.0, 1e6).description(""));
  const std::map<std::string, Partitioner> partitioners{{"rcb", Partitioner::rcb}, {"hsfc", Partitioner::hsfc}};
  command
      ->add_option_function<std::string>(
          "--partitioner",
          [options, partitioners](const std::string& name) {
            options->pile.settings.partitioner = partitioners.at(name);
          },
          "How space is cut: by planes, or along a Hilbert curve; rcb if not given")
      ->type_name("rcb|hsfc")
      ->check(CLI::IsMember({"rcb", "hsfc"}).description(""));
  command->callback([options, communicator] { run_pile(communicator, *options); });
}

}  // namespace tact::mpi::program
