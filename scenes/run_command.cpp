#include "scenes/run_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <chrono>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include "engine/base/parallel.h"
#include "scenes/common_options.h"
#include "scenes/interrupt.h"
#include "scenes/library/catalog.h"
#include "scenes/output_file.h"
#include "scenes/progress_line.h"
#include "scenes/report_json.h"
#include "scenes/run_totals.h"
#include "scenes/scene_pictures.h"
#include "scenes/usage_error.h"

namespace tact::scenes {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tact run cloth-over-sphere\n"
    "  tact run pile --size 1000 --frames 100 --no-pictures";

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

std::filesystem::path folder_of(const RunOptions& options) {
  return options.out.empty() ? std::filesystem::path("tact-" + options.scene) : options.out;
}

// Pictures play at half the speed of the scene at 30 a second.
int steps_a_picture(const DynamicsSettings& dynamics) {
  constexpr double kPicturesASecond = 60.0;  // of the scene
  return std::max(1, static_cast<int>(1.0 / (kPicturesASecond * dynamics.time_step) + 0.5));
}

// Everything that a run writes while it goes on.
class Outputs {
 public:
  Outputs(const RunOptions& options, const Scene& scene, const World& world, int threads, std::ostream& out)
      : steps_a_picture_(steps_a_picture(scene.dynamics)) {
    if (options.pictures) pictures_.emplace(options.scene, scene, folder_of(options), threads);
    if (options.json.empty()) return;
    json_file_.emplace(options.json, out);
    json_.emplace(json_file_->stream(), world);
  }

  void add_step(int step, const Simulation& simulation) {
    if (json_) json_->add_frame(step, *simulation.report());
    if (pictures_ && step % steps_a_picture_ == 0) pictures_->take(simulation);
  }

  void finish() {
    if (json_) json_->finish();
    if (json_file_) json_file_->finish();
    if (pictures_) sheet_ = pictures_->write_sheet();
  }

  void print(std::ostream& out) const {
    if (!sheet_) return;
    fmt::print(out, "\n{} pictures in {}, a sheet of them in {}\n", pictures_->count(), pictures_->folder().string(),
               sheet_->string());
  }

 private:
  int steps_a_picture_;
  std::optional<ScenePictures> pictures_;
  std::optional<OutputFile> json_file_;
  std::optional<JsonReport> json_;
  std::optional<std::filesystem::path> sheet_;
};

}  // namespace

void run(const RunOptions& options, std::ostream& out) {
  const auto start = std::chrono::steady_clock::now();
  const SceneEntry& entry = entry_of(options);
  Scene scene = entry.make(options.size > 0 ? options.size : entry.default_size);
  const int threads = options.threads > 0 ? options.threads : base::default_threads();
  std::optional<OutputFile> recording;
  if (!options.record.empty()) recording.emplace(options.record, out);
  Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics,
                        {.threads = threads, .accuracy = options.accuracy}, recording ? &recording->stream() : nullptr);
  Outputs outputs(options, scene, simulation.world(), threads, out);

  RunTotals totals;
  ProgressLine progress(options.frames);
  const Interrupt interrupt;
  for (int step = 0; step < options.frames && !interrupt.requested(); ++step) {
    simulation.step();
    totals.add_step(simulation);
    outputs.add_step(step, simulation);
    progress.show(step + 1);
  }
  progress.clear();
  outputs.finish();
  if (recording) recording->finish();
  if (options.json == "-") return;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  fmt::print(out, "{}{}\n", options.scene, totals.steps() < options.frames ? ", interrupted" : "");
  totals.print(out, simulation, wall.count(), scene.paper);
  outputs.print(out);
}

void add_run_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene, step by step, with pictures");
  const auto options = std::make_shared<RunOptions>();
  const auto folder = std::make_shared<std::string>();
  const auto no_pictures = std::make_shared<bool>(false);
  constexpr int kMost = std::numeric_limits<int>::max();
  command->footer(kExamples);
  command->add_option("SCENE", options->scene, "A scene that `tact scenes` lists")->required();
  command->add_option("--frames", options->frames, "How many steps; 300 if not given")
      ->type_name("N")
      ->check(CLI::Range(1, kMost));
  add_threads_option(*command, options->threads);
  add_accuracy_option(*command, options->accuracy);
  command->add_option("--size", options->size, "How large the scene is; `tact scenes` tells what it counts")
      ->type_name("N")
      ->check(CLI::Range(1, kMost));
  command->add_option("--out", *folder, "Write pictures to this folder; tact-SCENE if not given")->type_name("FOLDER");
  add_json_option(*command, options->json);
  add_record_option(*command, options->record);
  command->add_flag("--no-pictures", *no_pictures, "Write no pictures");
  command->callback([options, folder, no_pictures] {
    options->out = *folder;
    options->pictures = !*no_pictures;
    run(*options, std::cout);
  });
}

}  // namespace tact::scenes
