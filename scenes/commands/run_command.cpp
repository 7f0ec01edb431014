#include "scenes/commands/run_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "scenes/commands/common_options.h"
#include "scenes/commands/counted.h"
#include "scenes/commands/failures.h"
#include "scenes/commands/interrupt.h"
#include "scenes/commands/lost_pairs.h"
#include "scenes/commands/progress_line.h"
#include "scenes/commands/run_totals.h"
#include "scenes/commands/usage_error.h"
#include "scenes/commands/view_command.h"
#include "scenes/files/named_files.h"
#include "scenes/files/output_file.h"
#include "scenes/library/catalog.h"

namespace tact::scenes {
namespace {

constexpr const char* kRunExamples =
    "Examples:\n"
    "  tact run cloth-over-sphere\n"
    "  tact run pile --size 1000 --frames 100 --no-pictures\n"
    "  tact run bullets --continuous";

// What --view without a name stands for.
constexpr const char* kPageOfScene = "tact-SCENE.html";

const SceneEntry& entry_of(const RunOptions& options) {
  const SceneEntry* entry = find_scene(options.scene);
  if (entry == nullptr) throw UsageError(fmt::format("{}: no such scene (tact scenes lists them)", options.scene));
  if (options.size == 0) return *entry;
  if (entry->size_meaning.empty()) throw UsageError(fmt::format("--size: {} has one size only", entry->name));
  if (options.size < entry->smallest_size || options.size > entry->largest_size) {
    throw UsageError(fmt::format("--size: {} goes from {} to {}, not {}", entry->name, entry->smallest_size,
                                 entry->largest_size, options.size));
  }
  return *entry;
}

// Two reports in one stream or file would be none.
void check_outputs(const RunOptions& run) {
  const OutputOptions& options = run.outputs;
  std::vector<const char*> to_standard_output;
  for (const auto& [name, file] : std::initializer_list<std::pair<const char*, std::string>>{
           {"--json", options.json}, {"--contacts", options.contacts}, {"--states", options.states}}) {
    if (file == "-") to_standard_output.push_back(name);
  }
  if (to_standard_output.size() > 1) {
    throw UsageError(fmt::format("{} and {}: only one of them can go to standard output", to_standard_output[0],
                                 to_standard_output[1]));
  }
  if (options.gltf == "-") throw UsageError("--gltf: an animation goes to a file, not to standard output");
  NamedFiles files;
  files.add_output("--json", options.json);
  files.add_output("--contacts", options.contacts);
  files.add_output("--states", options.states);
  files.add_output("--trace", options.trace);
  files.add_output("--gltf", options.gltf);
  files.add_output("--record", run.record);
  files.add_output("--view", options.view.file);
  check_page_options(options.view);
}

// What the page shows besides is found where there is one.
Outputs outputs_of(const OutputOptions& options) {
  const bool page = !options.view.file.empty();
  return {.zones = options.zones || page, .patches = page, .points = options.points, .trace = !options.trace.empty()};
}

}  // namespace

void run(const RunOptions& options, std::ostream& out) {
  const auto start = std::chrono::steady_clock::now();
  check_outputs(options);
  const SceneEntry& entry = entry_of(options);
  Scene scene = entry.make(options.size > 0 ? options.size : entry.default_size);
  scene.marks.zones = options.outputs.zones;
  scene.dynamics.continuous = options.continuous;
  const int threads = options.threads > 0 ? options.threads : base::default_threads();
  const Interrupt interrupt;  // before any file is opened, so that none is left unfinished
  std::optional<OutputFile> recording;
  if (!options.record.empty()) recording.emplace(options.record, out, Appears::at_once);
  Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics,
                        {.threads = threads, .accuracy = options.accuracy, .outputs = outputs_of(options.outputs)},
                        recording ? &recording->stream() : nullptr);
  RunOutputs outputs(options.outputs, options.scene, scene, simulation.world(), threads, out);

  // What the paper's criteria lose is measured; the other levels promise all pairs or none.
  std::optional<LostPairs> lost;
  if (options.accuracy == Accuracy::paper) lost.emplace(simulation, threads);

  RunTotals totals;
  ProgressLine progress("step", options.frames, ProgressLine::Beside::nothing);
  for (int step = 0; step < options.frames && !interrupt.requested(); ++step) {
    simulation.step();
    totals.add_step(simulation);
    if (lost) lost->add_step(simulation);
    outputs.add_step(step, simulation);
    progress.show(step + 1, counted(simulation.report()->stats().touching_contacts, "contact"));
  }
  progress.clear();
  const Ending ending = totals.steps() < options.frames ? Ending::interrupted : Ending::complete;
  Failures failures;
  outputs.finish(ending, failures);
  if (recording) failures.attempt([&] { recording->finish(); });
  const OutputOptions& files = options.outputs;
  if (files.json != "-" && files.contacts != "-" && files.states != "-") {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    if (options.prints == RunOptions::Prints::all) {
      fmt::print(out, "{}{}\n", options.scene, ending == Ending::interrupted ? ", interrupted" : "");
      totals.print(out, simulation, wall.count(), scene.paper);
      if (lost) lost->print(out);
      fmt::print(out, "\n");
    }
    outputs.print(out);
  }
  failures.report();
}

void add_run_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene, step by step, with pictures");
  const auto options = std::make_shared<RunOptions>();
  const auto no_pictures = std::make_shared<bool>(false);
  constexpr int kMost = std::numeric_limits<int>::max();
  OutputOptions& outputs = options->outputs;
  command->footer(kRunExamples);
  command->add_option("SCENE", options->scene, "A scene that `tact scenes` lists")->required();
  command->add_option("--frames", options->frames, "How many steps; 300 if not given")
      ->type_name("N")
      ->check(CLI::Range(1, kMost).description(""));
  add_threads_option(*command, options->threads);
  add_accuracy_option(*command, options->accuracy);
  command->add_option("--size", options->size, "How large the scene is; `tact scenes` tells what it counts")
      ->type_name("N")
      ->check(CLI::Range(1, kMost).description(""));
  command->add_flag("--continuous", options->continuous,
                    "Stop bodies before they meet on their way from step to step, so that nothing passes through");
  command->add_option("--out", outputs.out, "Write pictures and their film to this folder; tact-SCENE if not given")
      ->type_name("FOLDER")
      ->check(refuse_empty_name);
  command->add_flag("--no-pictures", *no_pictures, "Write no pictures and no film");
  command
      ->add_option("--every", outputs.every, "Steps from one picture to the next; if not given, as many as 1/60 s has")
      ->type_name("N")
      ->check(CLI::Range(1, kMost).description(""));
  command->add_flag("--zones", outputs.zones, "Show the impact zones in pictures; the engine then computes them");
  add_json_option(*command, outputs.json);
  command->add_option("--contacts", outputs.contacts, "Write the contacts as JSON, a line a step; - is standard output")
      ->type_name("FILE|-")
      ->check(refuse_empty_name);
  command
      ->add_option("--states", outputs.states,
                   "Write how each step went as JSON, a line a step: energy, deepest point, who sleeps; - likewise")
      ->type_name("FILE|-")
      ->check(refuse_empty_name);
  command->add_option("--gltf", outputs.gltf, "Write the bodies, at every picture, as an animated glTF file")
      ->type_name("FILE.glb")
      ->check(refuse_empty_name);
  command->add_option("--vtk", outputs.vtk, "Write the bodies, at every picture, to this folder for ParaView")
      ->type_name("FOLDER")
      ->check(refuse_empty_name);
  command
      ->add_option("--view", outputs.view.file,
                   "Write a page for the browser that plays the run; zones and patches are then found, too")
      ->type_name("[FILE.html]")
      ->expected(0, 1)
      ->default_str(kPageOfScene)
      ->check(refuse_empty_name);
  add_page_options(*command, outputs.view);
  for (const char* of_page : {"--from", "--to", "--few-points", "--largest"})
    command->get_option(of_page)->needs(command->get_option("--view"));
  add_trace_option(*command, outputs.trace);
  add_record_option(*command, options->record);
  command->callback([options, no_pictures] {
    options->outputs.pictures = !*no_pictures;
    if (options->outputs.view.file == kPageOfScene) options->outputs.view.file = page_of(options->scene);
    options->outputs.view.every = std::max(options->outputs.every, 1);
    run(*options, std::cout);
  });
}

}  // namespace tact::scenes
