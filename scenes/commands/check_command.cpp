#include "scenes/commands/check_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <tact/recording.h>
#include <tact/world.h>

#include <CLI/Validators.hpp>
#include <algorithm>
#include <charconv>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/base/parallel.h"
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
#include "scenes/files/body_files.h"
#include "scenes/files/named_files.h"
#include "scenes/files/output_file.h"
#include "scenes/files/weld_frames.h"

namespace tact::scenes {
namespace {

constexpr const char* kCheckExamples =
    R"(A folder is one moving body: its mesh files in the order of their names, frame_2 before
frame_10, a file a frame; all folders must hold the same number of frames. A single file
stands still.
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
  tact check bullet/ wall.obj --sheet wall --impacts)";

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

template <class Bodies>
std::string names_of(const Bodies& bodies) {
  std::string names;
  for (const BodyFrames& body : bodies) names += (names.empty() ? "" : ", ") + body.name;
  return names;
}

// "part#2" for "part.stl#2".
std::string without_ending(const BodyFrames& body) {
  if (body.moves) return body.name;
  const std::filesystem::path file = body.files.front().filename();
  return file.stem().string() + body.name.substr(file.string().size());
}

// The body that an option names, with its ending or without.
BodyFrames& body_named(const std::string& option, const std::string& name, std::vector<BodyFrames>& bodies) {
  const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const BodyFrames& b) { return b.name == name; });
  if (found != bodies.end()) return *found;
  std::vector<std::reference_wrapper<BodyFrames>> fitting;
  std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(fitting),
               [&](const BodyFrames& b) { return without_ending(b) == name; });
  if (fitting.size() == 1) return fitting.front();
  if (fitting.empty())
    throw UsageError(fmt::format("{} {}: no body has this name; the bodies are: {}", option, name, names_of(bodies)));
  throw UsageError(
      fmt::format("{} {}: the name without its ending of several bodies: {}", option, name, names_of(fitting)));
}

void mark_sheets(const std::vector<std::string>& sheets, std::vector<BodyFrames>& bodies) {
  for (const std::string& sheet : sheets) body_named("--sheet", sheet, bodies).surface = Surface::sheet;
}

void mark_selves(const std::vector<std::string>& selves, std::vector<BodyFrames>& bodies) {
  for (const std::string& self : selves) {
    if (self != "all") {
      body_named("--self", self, bodies).self_contact = true;
      continue;
    }
    for (BodyFrames& body : bodies) body.self_contact = true;
  }
}

double margin_from(const std::string& option, std::string_view text) {
  double margin = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), margin);
  if (problem != std::errc() || end != text.data() + text.size() || !(margin >= 0.0 && margin <= kLargestCoordinate))
    throw UsageError(fmt::format("--margin {}: '{}' is not a length of 0 to 2^300 metres", option, text));
  return margin;
}

// A name may hold "=": the margin stands after the last one. A margin of all bodies leaves those named alone.
void set_margins(const std::vector<std::string>& margins, std::vector<BodyFrames>& bodies) {
  for (const std::string& option : margins) {
    if (option.find('=') != std::string::npos) continue;
    for (BodyFrames& body : bodies) body.margin = margin_from(option, option);
  }
  for (const std::string& option : margins) {
    const std::size_t equals = option.rfind('=');
    if (equals == std::string::npos) continue;
    body_named("--margin", option.substr(0, equals), bodies).margin =
        margin_from(option, std::string_view(option).substr(equals + 1));
  }
}

void check_outputs(const CheckOptions& options, const std::vector<BodyFrames>& bodies) {
  NamedFiles files;
  for (const BodyFrames& body : bodies) {
    for (const std::filesystem::path& file : body.files) files.add_input(file);
  }
  files.add_output("--json", options.json);
  files.add_output("--record", options.record);
  files.add_output("--out", options.view.file);
}

// The places of two bodies that are not held against each other.
using ExcludedPair = std::pair<std::size_t, std::size_t>;
std::vector<ExcludedPair> excluded_pairs(const CheckOptions& options, std::vector<BodyFrames>& bodies) {
  std::vector<ExcludedPair> pairs;
  for (const auto& [a, b] : options.excluded) {
    const auto place = [&](const std::string& name) {
      return static_cast<std::size_t>(&body_named("--exclude", name, bodies) - bodies.data());
    };
    pairs.emplace_back(place(a), place(b));
    if (pairs.back().first == pairs.back().second)
      throw UsageError(
          fmt::format("--exclude {} {}: these are one body; without --self it is not held against itself", a, b));
  }
  return pairs;
}

// The engine's message names the body; the file tells which frame it is.
[[noreturn]] void rethrow_for_file(const std::filesystem::path& file, const Error& error) {
  throw FileError(fmt::format("{}: {}", file.string(), error.what()));
}

// Bodies that stand still are moving ones that do not move: two of them must still be tested.
std::vector<BodyId> add_bodies(const std::vector<BodyFrames>& bodies, World& world) {
  std::vector<BodyId> ids;
  for (const BodyFrames& body : bodies) {
    try {
      ids.push_back(world.add_body({.positions = body.positions.front(),
                                    .facets = body.facets,
                                    .surface = body.surface,
                                    .name = body.name,
                                    .margin = body.margin,
                                    .self_contact = body.self_contact}));
    } catch (const Error& error) {
      rethrow_for_file(body.files.front(), error);
    }
  }
  return ids;
}

void set_frame(const std::vector<BodyFrames>& bodies, const std::vector<BodyId>& ids, int frame, World& world) {
  std::vector<PositionsUpdate> updates;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].moves) updates.push_back({ids[i], bodies[i].positions[frame]});
  }
  world.set_positions(updates);
}

ViewTitle title_of(const std::vector<BodyFrames>& bodies) { return {.name = names_of(bodies), .kind = "meshes"}; }

// The file of each body, if one of them moves.
std::vector<std::string> files_of(const std::vector<BodyFrames>& bodies, int frame) {
  std::vector<std::string> files;
  if (frame_count(bodies) == 0) return files;
  for (const BodyFrames& body : bodies) files.push_back(body.files[body.moves ? frame : 0].string());
  return files;
}

std::vector<Weld> welds_of(const CheckOptions& options, const std::vector<BodyFrames>& bodies) {
  std::vector<Weld> welds;
  if (!options.weld) return welds;
  for (const BodyFrames& body : bodies) welds.push_back(body.weld);
  return welds;
}

void print_welds(const std::vector<BodyFrames>& bodies, std::ostream& out) {
  for (const BodyFrames& body : bodies) {
    fmt::print(out, "welded {}: {} of {} merged with another", body.name, body.weld.merged_vertices,
               counted(body.positions.front().cols() + body.weld.merged_vertices, "vertex", "vertices"));
    if (body.weld.collapsed_facets > 0) fmt::print(out, ", {} collapsed", counted(body.weld.collapsed_facets, "facet"));
    fmt::print(out, "\n");
  }
}

int frames_to_step(const CheckOptions& options, const std::vector<BodyFrames>& bodies) {
  const int held = frame_count(bodies);
  return held > 0 ? held : std::max(options.frames, 1);
}

}  // namespace

void check(const CheckOptions& options, std::ostream& out) {
  std::vector<BodyFrames> bodies = bodies_of(options);
  for (const BodyFrames& body : bodies) {
    for (const std::string& warning : body.warnings) print_warning(warning);
  }
  mark_sheets(options.sheets, bodies);
  mark_selves(options.selves, bodies);
  set_margins(options.margins, bodies);
  const std::vector<ExcludedPair> excluded = excluded_pairs(options, bodies);
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
    if (message.kind == MessageKind::open_surface) print_warning(message.text);
  };
  World world({.threads = threads, .accuracy = options.accuracy, .outputs = outputs, .on_message = warn_of_bodies});
  if (recording) world.set_observer(&recorder.emplace(recording->stream()));
  const std::vector<BodyId> ids = add_bodies(bodies, world);
  for (const auto& [a, b] : excluded) world.set_excluded(ids[a], ids[b], true);

  std::optional<ViewPage> page;
  if (!options.view.file.empty()) page.emplace(options.view, title_of(bodies), out);
  std::optional<JsonReport> json;
  if (json_file)
    json.emplace(json_file->stream(), world, page ? JsonReport::Outcomes::counts : JsonReport::Outcomes::none,
                 options.surfaces ? JsonReport::Surfaces::checked : JsonReport::Surfaces::taken,
                 welds_of(options, bodies));
  std::optional<TableReport> table;
  if (options.json != "-" && options.table) {
    if (options.surfaces) print_surfaces(out, world);
    table.emplace(out, world);
    if (options.weld) print_welds(bodies, out);
  }

  const int frames = frames_to_step(options, bodies);
  ProgressLine progress("frame", frames, ProgressLine::Beside::output);
  int frame = 0;
  for (; frame < frames && !interrupt.requested(); ++frame) {
    if (frame > 0) set_frame(bodies, ids, frame, world);
    const MotionReport* const motion = options.impacts && frame > 0 ? &world.detect_motion() : nullptr;
    const Report& report = world.detect();
    if (json) json->add_frame(frame, report, motion, files_of(bodies, frame));
    if (table) table->add_frame(frame, report, motion);
    if (page) page->add_step(frame, std::nullopt, world, report);
    progress.show(frame + 1);
  }
  progress.clear();
  const Ending ending = frame < frames ? Ending::interrupted : Ending::complete;
  if (table && ending == Ending::interrupted) fmt::print(out, "\ninterrupted after {} of {} frames\n", frame, frames);
  if (table) table->finish();
  Failures failures;
  if (json) {
    failures.attempt([&] {
      json->finish(ending);
      json_file->finish();
    });
  }
  if (recording) failures.attempt([&] { recording->finish(); });
  if (page) failures.attempt([&] { page->finish(ending); });
  failures.report();
  if (page && options.json != "-") fmt::print(out, "{}\n", page->summary());
}

void add_check_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("check", "Find where the bodies of mesh files touch");
  const auto options = std::make_shared<CheckOptions>();
  const auto meshes = std::make_shared<std::vector<std::string>>();
  command->footer(kCheckExamples);
  command->add_option("MESH", *meshes, "Mesh files (.obj, .off, .ply, .stl) and folders of them")
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
  command->callback([options, meshes] {
    options->meshes.assign(meshes->begin(), meshes->end());
    check(*options, std::cout);
  });
}

}  // namespace tact::scenes
