#include "scenes/commands/replay_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <tact/recording.h>

#include <CLI/Validators.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/timer.h"
#include "scenes/commands/common_options.h"
#include "scenes/commands/counted.h"
#include "scenes/commands/interrupt.h"
#include "scenes/files/mapped_file.h"
#include "scenes/files/of_recording.h"
#include "scenes/files/source.h"

namespace tact::scenes {
namespace {

constexpr const char* kReplayExamples =
    "A hash is made from every bit of a step's answer. Other threads must give the same; another version of tact need "
    "not.\n\n"
    "Examples:\n"
    "  tact run pile --frames 100 --no-pictures --record pile.tactrec\n"
    "  tact replay pile.tactrec --threads 1";

}  // namespace

void replay(const ReplayOptions& options, std::ostream& out) {
  const MappedFile file(options.recording);
  const std::string name = options.recording.string();
  base::Timer timer;
  RecordingPlayer player = open_recording(file.bytes(), name, {.threads = options.threads, .outputs = {}});
  int steps = 0;
  int different = 0;
  std::optional<PlayedStep> first;
  const Interrupt interrupt;
  while (!interrupt.requested()) {
    const std::optional<PlayedStep> step = of_recording(name, [&] { return player.next(); });
    if (!step) break;
    if (!step->recorded) {
      fmt::print(out, "step {} had no answer when it was recorded; now {:016x}\n", step->number, step->now);
      continue;
    }
    ++steps;
    if (step->same()) continue;
    ++different;
    if (!first) first = step;
    fmt::print(out, "step {}: {:016x} in the recording, {:016x} now\n", step->number, *step->recorded, step->now);
  }
  if (const std::optional<std::size_t> cut = player.cut_at()) {
    fmt::print(out, "the recording is cut off in the record at byte {}: all before it was played\n", *cut);
  }
  fmt::print(out, "{} on {} in {:.2f} s{}: {}\n", counted(steps, "step"),
             counted(player.world().settings().threads, "thread"), 1e-3 * timer.lap(),
             interrupt.requested() ? ", interrupted" : "",
             different == 0 ? "all hashes are the same" : fmt::format("{} of {} hashes differ", different, steps));
  if (first) {
    throw FileError(fmt::format("{}: byte {}: step {} is the first whose hash differs; tact {} recorded it", name,
                                first->byte, first->number, printable(player.recorded_by())));
  }
}

void add_replay_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("replay", "Run a recording again and compare the hash of every step");
  const auto file = std::make_shared<std::string>();
  const auto threads = std::make_shared<int>(0);
  command->footer(kReplayExamples);
  command->add_option("FILE", *file, "What --record wrote")->required();
  add_threads_option(*command, *threads);
  CLI::Option* given = command->get_option("--threads");
  given->description(
      "How many threads to use, 0: as many as OpenMP would use; as many as the recording had if not given");
  command->callback([file, threads, given] {
    replay({.recording = *file, .threads = given->count() > 0 ? std::optional<int>(*threads) : std::nullopt},
           std::cout);
  });
}

}  // namespace tact::scenes
