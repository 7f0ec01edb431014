#include "scenes/commands/check_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <tact/recording.h>
#include <tact/world.h>

#include <CLI/Validators.hpp>
#include <algorithm>
#include <charconv>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/base/parallel.h"
#include "scenes/commands/check_steps.h"
#include "scenes/commands/common_options.h"
#include "scenes/commands/counted.h"
#include "scenes/commands/failures.h"
#include "scenes/commands/interrupt.h"
#include "scenes/commands/progress_line.h"
#include "scenes/commands/report_json.h"
#include "scenes/commands/report_table.h"
#include "scenes/commands/standard_error.h"
#include "scenes/commands/surface_report.h"
#include "scenes/commands/usage_error.h"
#include "scenes/export/vtk.h"
#include "scenes/files/body_files.h"
#include "scenes/files/named_files.h"
#include "scenes/files/output_file.h"
#include "scenes/files/weld_frames.h"

namespace tact::scenes {
namespace {

constexpr const char* kCheckExamples =
    R"(A folder is one moving body: its mesh files in the order of their names, frame_2 before
frame_10, a file a frame; all folders must hold the same number of frames. A single file
stands still. A series for ParaView (.pvd) moves, too: each of its parts and, where its
files tell, each of their bodies is a body.
All files are read before the first step and held in memory: 24 bytes a vertex and frame.
A body's name is its file's or folder's name; a repeated one gets #2 and so on. Options
take a name without its ending, too, where only one body has it.

Examples:
  tact check spot.ply fish.obj
  tact check sphere.obj cloth_frames/ --sheet cloth_frames --json contacts.json
  tact check part.stl part.stl --sheet part.stl#2 --accuracy hulls
  tact check scan.obj --weld --self scan
  tact check a.off b.off c.off --json - | python3 -m json.tool
  tact check cloth/ ball.obj --sheet cloth --self cloth --margin 0.004 --points --json -
  tact check upper_arm.obj lower_arm.obj table.obj --exclude upper_arm lower_arm
  tact check bullet/ wall.obj --sheet wall --impacts
  tact check run.pvd --margin 0.004 --points --vtk found)";

std::vector<BodyFrames> bodies_of(const CheckOptions& options) {
  const int most_frames = options.frames > 0 ? options.frames : std::numeric_limits<int>::max();
  std::optional<ProgressLine> line;
  std::vector<BodyFrames> bodies = read_bodies(options.meshes, most_frames, [&](int done, int all) {
    if (!line) line.emplace("reading file", all, ProgressLine::Beside::nothing);
    line->show(done);
  });
  if (options.weld) std::for_each(bodies.begin(), bodies.end(), weld_frames);
  return bodies;
}

double margin_from(const std::string& option, std::string_view text) {
  double margin = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), margin);
  if (problem != std::errc() || end != text.data() + text.size() || !(margin >= 0.0 && margin <= kLargestCoordinate))
    throw UsageError(fmt::format("--margin {}: '{}' is not a length of 0 to 2^300 metres", option, text));
  return margin;
}

// A name may hold "=": the margin stands after the last one. A margin of all bodies leaves those named alone.
BodyOptions body_options(const CheckOptions& options) {
  BodyOptions result{.sheets = options.sheets, .selves = options.selves, .excluded = options.excluded};
  for (const std::string& option : options.margins) {
    const std::size_t equals = option.rfind('=');
    if (equals == std::string::npos) {
      result.margin = margin_from(option, option);
    } else {
      result.margins.emplace_back(option.substr(0, equals),
                                  margin_from(option, std::string_view(option).substr(equals + 1)));
    }
  }
  return result;
}

constexpr const char* kVtkName = "check";

void check_outputs(const CheckOptions& options, const std::vector<BodyFrames>& bodies) {
  NamedFiles files;
  for (const BodyFrames& body : bodies) {
    for (const std::filesystem::path& file : body.files) files.add_input(file);
  }
  files.add_output("--json", options.json);
  files.add_output("--record", options.record);
  files.add_output("--out", options.view.file);
  if (options.vtk.empty()) return;
  for (const std::filesystem::path& mesh : options.meshes) {
    std::error_code not_there;
    if (std::filesystem::is_directory(mesh, not_there) && std::filesystem::equivalent(mesh, options.vtk, not_there))
      throw UsageError(
          fmt::format("--vtk: {} is read, and what is written there would be frames of it", mesh.string()));
  }
  for (const BodyFrames& body : bodies) {
    for (const std::filesystem::path& file : body.files) {
      std::error_code not_there;
      const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
      if (file.filename().string().starts_with(kVtkName) && std::filesystem::equivalent(folder, options.vtk, not_there))
        throw UsageError(fmt::format("--vtk: {} is read, and would be lost", file.string()));
    }
  }
}

ViewTitle title_of(const std::vector<BodyFrames>& bodies) { return {.name = names_of(bodies), .kind = "meshes"}; }

void print_welds(const std::vector<BodyFrames>& bodies, std::ostream& out) {
  for (const BodyFrames& body : bodies) {
    fmt::print(out, "welded {}: {} of {} merged with another", body.name, body.weld.merged_vertices,
               counted(body.positions.front().cols() + body.weld.merged_vertices, "vertex", "vertices"));
    if (body.weld.collapsed_facets > 0) fmt::print(out, ", {} collapsed", counted(body.weld.collapsed_facets, "facet"));
    fmt::print(out, "\n");
  }
}

// The bodies of a frame, coloured by what meets and how near it is.
void write_vtk(const CheckSteps& steps, const Report& report, double time, const World& world, VtkSeries& series) {
  const std::vector<SurfaceFields> fields = surface_fields(report, world, steps.ids());
  std::vector<PictureBody> bodies;
  for (std::size_t i = 0; i < steps.ids().size(); ++i) {
    Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(world.vertex_count(steps.ids()[i])));
    world.copy_positions(steps.ids()[i], {positions.data(), static_cast<std::size_t>(positions.size())});
    bodies.push_back({.name = steps.bodies()[i].name,
                      .positions = std::move(positions),
                      .facets = steps.bodies()[i].facets,
                      .color = {},
                      .meeting_facets = fields[i].crossing});
  }
  series.write(bodies, time, fields);
}

int frames_to_step(const CheckOptions& options, const std::vector<BodyFrames>& bodies) {
  const int held = frame_count(bodies);
  return held > 0 ? held : std::max(options.frames, 1);
}

// What is written of each frame: a page to look at, JSON, a table, files for ParaView.
class FrameWriters {
 public:
  FrameWriters(const CheckOptions& options, const CheckSteps& steps, const World& world, OutputFile* json_file,
               std::ostream& out)
      : steps_(steps), world_(world), json_file_(json_file), out_(out), standard_output_is_json_(options.json == "-") {
    if (!options.view.file.empty()) page_.emplace(options.view, title_of(steps.bodies()), out);
    if (json_file != nullptr)
      json_.emplace(json_file->stream(), world, page_ ? JsonReport::Outcomes::counts : JsonReport::Outcomes::none,
                    options.surfaces ? JsonReport::Surfaces::checked : JsonReport::Surfaces::taken,
                    options.weld ? steps.welds() : std::vector<Weld>());
    if (!standard_output_is_json_ && options.table) {
      if (options.surfaces) print_surfaces(out, world);
      table_.emplace(out, world);
      if (options.weld) print_welds(steps.bodies(), out);
    }
    if (!options.vtk.empty()) vtk_.emplace(options.vtk, kVtkName);
  }

  void add(int frame, const CheckedFrame& checked, std::optional<double> time) {
    if (json_) json_->add_frame(frame, checked.report, checked.motion, steps_.files_of(frame), time);
    if (table_) table_->add_frame(frame, checked.report, checked.motion);
    if (page_) page_->add_step(frame, time, world_, checked.report);
    if (vtk_) write_vtk(steps_, checked.report, time.value_or(frame), world_, *vtk_);
  }

  void finish_table(int frame, int frames) {
    if (!table_) return;
    if (frame < frames) fmt::print(out_, "\ninterrupted after {} of {} frames\n", frame, frames);
    table_->finish();
  }
  void finish_json(Ending ending) {
    if (!json_) return;
    json_->finish(ending);
    json_file_->finish();
  }
  void finish_page(Ending ending) {
    if (page_) page_->finish(ending);
  }
  void print_where() const {
    if (page_ && !standard_output_is_json_) fmt::print(out_, "{}\n", page_->summary());
    if (vtk_ && table_) fmt::print(out_, "frames for ParaView: {}\n", vtk_->index_file().string());
  }

 private:
  const CheckSteps& steps_;
  const World& world_;
  OutputFile* const json_file_;  // null: none
  std::ostream& out_;
  const bool standard_output_is_json_;
  std::optional<ViewPage> page_;
  std::optional<JsonReport> json_;
  std::optional<TableReport> table_;
  std::optional<VtkSeries> vtk_;
};

}  // namespace

void check(const CheckOptions& options, std::ostream& out) {
  std::vector<BodyFrames> bodies = bodies_of(options);
  for (const BodyFrames& body : bodies) {
    for (const std::string& warning : body.warnings) print_warning(warning);
  }
  const std::vector<ExcludedPair> excluded = apply_body_options(body_options(options), bodies);
  check_outputs(options, bodies);
  const int threads = options.threads > 0 ? options.threads : base::default_threads();
  const Interrupt interrupt;  // before any file is opened, so that none is left unfinished
  std::optional<OutputFile> json_file;
  if (!options.json.empty()) json_file.emplace(options.json, out);
  std::optional<OutputFile> recording;
  if (!options.record.empty()) recording.emplace(options.record, out, Appears::at_once);
  std::optional<Recorder> recorder;
  Outputs outputs = options.outputs;
  outputs.patches = outputs.patches || outputs.points;
  const auto warn_of_bodies = [](const Message& message) {
    if (message.kind == MessageKind::open_surface || message.kind == MessageKind::inside_out)
      print_warning(message.text);
  };
  World world({.threads = threads, .accuracy = options.accuracy, .outputs = outputs, .on_message = warn_of_bodies});
  if (recording) world.set_observer(&recorder.emplace(recording->stream()));
  const int frames = frames_to_step(options, bodies);
  CheckSteps steps(std::move(bodies), excluded, world);

  FrameWriters writers(options, steps, world, json_file ? &*json_file : nullptr, out);
  const std::vector<double> times = times_of(steps.bodies());
  ProgressLine progress("frame", frames, ProgressLine::Beside::output);
  int frame = 0;
  for (; frame < frames && !interrupt.requested(); ++frame) {
    const CheckedFrame checked = steps.step(frame, options.impacts);
    writers.add(frame, checked, times.empty() ? std::nullopt : std::optional(times[static_cast<std::size_t>(frame)]));
    progress.show(frame + 1);
  }
  progress.clear();
  writers.finish_table(frame, frames);
  const Ending ending = frame < frames ? Ending::interrupted : Ending::complete;
  Failures failures;
  failures.attempt([&] { writers.finish_json(ending); });
  if (recording) failures.attempt([&] { recording->finish(); });
  failures.attempt([&] { writers.finish_page(ending); });
  failures.report();
  writers.print_where();
}

void add_check_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("check", "Find where the bodies of mesh files touch");
  const auto options = std::make_shared<CheckOptions>();
  const auto meshes = std::make_shared<std::vector<std::string>>();
  command->footer(kCheckExamples);
  command
      ->add_option("MESH", *meshes, "Mesh files (.obj, .off, .ply, .stl, .vtp, .vtk), folders of them, series (.pvd)")
      ->type_name("")
      ->required();
  command->add_option("--sheet", options->sheets, "This body is a sheet: cloth, without an inside; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      ->add_option("--margin", options->margins,
                   "The margin in metres, of every body or of one: how far ahead of a surface points are seen; may be "
                   "repeated")
      ->type_name("[NAME=]M")
      ->allow_extra_args(false);
  command->add_option("--self", options->selves, "Hold this body against itself, too, or all; may be repeated")
      ->type_name("NAME|all")
      ->allow_extra_args(false);
  command
      ->add_option("--exclude", options->excluded,
                   "Do not hold these two bodies against each other, the sides of a joint, say; may be repeated")
      ->type_name("NAME NAME")
      ->allow_extra_args(false);
  command->add_flag("--weld", options->weld,
                    "Vertices with equal positions, in every frame, are one: for meshes with a vertex a corner");
  command->add_flag("--points", options->outputs.points,
                    "Find the contact points: where surfaces are nearest within their margins (in --json)");
  command->add_flag("--curves", options->outputs.curves,
                    "Find the curves in which surfaces cross, as lines of points in order (in --json)");
  command->add_flag("--within-reach", options->outputs.within_reach,
                    "Count the pairs of features that are nearer than their margins, for barriers (in --json)");
  command->add_flag("--impacts", options->impacts,
                    "Find what meets between a frame and the next, every vertex moving straight (all in --json)");
  command->add_flag("--surfaces", options->surfaces,
                    "Check what each surface is: borders, turned and repeated facets, crossings with itself, slivers");
  add_accuracy_option(*command, options->accuracy);
  add_threads_option(*command, options->threads);
  command
      ->add_option("--frames", options->frames, "Step through the first N frames only; without folders, step N times")
      ->type_name("N")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()).description(""));
  add_json_option(*command, options->json);
  add_record_option(*command, options->record);
  command
      ->add_option("--vtk", options->vtk,
                   "Write the bodies of every frame, with what was found, to this folder for ParaView")
      ->type_name("FOLDER")
      ->check(refuse_empty_name);
  command->callback([options, meshes] {
    options->meshes.assign(meshes->begin(), meshes->end());
    check(*options, std::cout);
  });
}

}  // namespace tact::scenes
