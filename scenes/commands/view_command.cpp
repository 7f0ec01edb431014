#include "scenes/commands/view_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <tact/recording.h>
#include <unistd.h>

#include <CLI/Validators.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>

#include "scenes/commands/common_options.h"
#include "scenes/commands/interrupt.h"
#include "scenes/commands/progress_line.h"
#include "scenes/commands/report_json.h"
#include "scenes/commands/run_command.h"
#include "scenes/commands/usage_error.h"
#include "scenes/files/mapped_file.h"
#include "scenes/files/named_files.h"
#include "scenes/files/of_recording.h"
#include "scenes/library/catalog.h"
#include "scenes/pictures/program.h"

namespace tact::scenes {
namespace {

constexpr const char* kViewExamples =
    R"(The page needs no network: open it in a browser, or send it to somebody. In it
positions are rounded, to less than 1/1024 of a body's size; numbers are not.
A recording is shown as this version of tact answers it, with zones.

Examples:
  tact view cloth-over-sphere --frames 120
  tact run pile --frames 60 --no-pictures --record pile.tactrec; tact view pile.tactrec
  tact view cloth_frames/ ball.obj --sheet cloth_frames --margin 0.004 --points
  tact view pile --size 1000 --few-points --out pile.html)";

bool is_recording(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  constexpr std::string_view kMagic = "tactrec\n";  // see <tact/recording.h>
  std::string begin(kMagic.size(), '\0');
  return std::filesystem::is_regular_file(path) &&
         file.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == kMagic;
}

std::string stem_of(const std::string& what) {
  std::filesystem::path path(what);
  if (path.filename().empty()) path = path.parent_path();  // a folder with a slash after it
  return path.stem().string();
}

ViewOptions named_page(const ViewCommandOptions& options) {
  ViewOptions page = options.page;
  if (page.file.empty()) page.file = page_of(stem_of(options.what.front()));
  return page;
}

void view_recording(const ViewCommandOptions& options, const ViewOptions& page_options, std::ostream& out) {
  const std::string& name = options.what.front();
  NamedFiles files;
  files.add_input(name);
  files.add_output("--out", page_options.file);
  files.add_output("--json", options.json);
  const MappedFile file(name);
  const Interrupt interrupt;
  std::optional<OutputFile> json_file;
  if (!options.json.empty()) json_file.emplace(options.json, out);
  ViewPage page(page_options, {.name = std::filesystem::path(name).filename().string(), .kind = "recording"}, out);
  Outputs outputs = options.outputs;
  outputs.zones = true;
  RecordingPlayer player = open_recording(file.bytes(), name, {.threads = options.threads, .outputs = outputs});
  std::optional<JsonReport> json;
  while (!interrupt.requested()) {
    const std::optional<PlayedStep> step = of_recording(name, [&] { return player.next(); });
    if (!step || step->number > page_options.to) break;
    page.add_step(step->number, std::nullopt, player.world(), player.report());
    if (json_file && !json) json.emplace(json_file->stream(), player.world(), JsonReport::Outcomes::counts);
    if (json) json->add_frame(step->number, player.report());
  }
  if (const std::optional<std::size_t> cut = player.cut_at()) {
    throw FileError(fmt::format("{}: byte {}: the recording is cut off in this record; --to shows the steps before it",
                                name, *cut));
  }
  const Ending ending = interrupt.requested() ? Ending::interrupted : Ending::complete;
  page.finish(ending);
  if (json) {
    json->finish(ending);
    json_file->finish();
  }
  if (options.json != "-") fmt::print(out, "{}\n", page.summary());
}

void view_scene(const ViewCommandOptions& options, const ViewOptions& page, std::ostream& out) {
  constexpr int kFrames = 300;
  RunOptions run_options{.scene = options.what.front(),
                         .frames = options.frames > 0 ? options.frames : kFrames,
                         .size = options.size,
                         .accuracy = options.accuracy,
                         .threads = options.threads.value_or(0),
                         .continuous = options.continuous,
                         .outputs = {.pictures = false,
                                     .zones = true,
                                     .points = options.outputs.points,
                                     .json = options.json,
                                     .view = page},
                         .prints = RunOptions::Prints::files};
  run(run_options, out);
}

void view_meshes(const ViewCommandOptions& options, const ViewOptions& page, std::ostream& out) {
  CheckOptions check_options = options.check;
  check_options.meshes.assign(options.what.begin(), options.what.end());
  check_options.accuracy = options.accuracy;
  check_options.threads = options.threads.value_or(0);
  check_options.frames = options.frames;
  check_options.json = options.json;
  check_options.outputs = options.outputs;
  check_options.outputs.zones = true;
  check_options.outputs.points = options.outputs.points || !options.check.margins.empty();
  check_options.view = page;
  check_options.table = false;
  check(check_options, out);
}

// The browser is the user's: what it says is not ours to show.
void open_page(const std::string& file, std::ostream& out) {
  const std::filesystem::path page = std::filesystem::absolute(file);
  const std::filesystem::path log = std::filesystem::temp_directory_path() / fmt::format("tact-open-{}.log", getpid());
  const ProgramResult result = run_program({"xdg-open", page.string()}, page.parent_path(), log);
  if (result.end == ProgramResult::End::success) return;
  fmt::print(out, "{}: open it in a browser\n",
             result.end == ProgramResult::End::missing ? "xdg-open is not installed (package xdg-utils)"
                                                       : "xdg-open could not show the page");
}

void check_use(const ViewCommandOptions& options) {
  if (options.page.file == "-" && options.json == "-") {
    throw UsageError("--out and --json: only one of them can go to standard output");
  }
  if (options.opens && (options.page.file == "-" || options.json == "-")) {
    throw UsageError("--open: nothing can go to standard output");
  }
  check_page_options(options.page);
}

enum class Shown { recording, scene, meshes };

// What would do nothing is refused.
void check_is_used(const ViewCommandOptions& options, Shown shown) {
  const auto refuse = [](bool given, const char* option, const char* what) {
    if (given) throw UsageError(fmt::format("{}: it is for {}", option, what));
  };
  if (shown != Shown::meshes) {
    refuse(options.check.weld, "--weld", "meshes");
    refuse(!options.check.sheets.empty(), "--sheet", "meshes");
    refuse(!options.check.margins.empty(), "--margin", "meshes");
    refuse(!options.check.selves.empty(), "--self", "meshes");
  }
  if (shown != Shown::scene) {
    refuse(options.size > 0, "--size", "scenes");
    refuse(options.continuous, "--continuous", "scenes");
  }
  refuse(shown == Shown::recording && options.frames > 0, "--frames", "scenes and meshes");
  refuse(shown == Shown::scene && options.outputs.curves, "--curves", "recordings and meshes");
}

void add_mesh_options(CLI::App& command, CheckOptions& check) {
  command.add_flag("--weld", check.weld, "Meshes: vertices with equal positions are one");
  command.add_option("--sheet", check.sheets, "Meshes: this body is a sheet; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command.add_option("--margin", check.margins, "Meshes: the margin in metres, as of tact check; may be repeated")
      ->type_name("[NAME=]M")
      ->allow_extra_args(false);
  command.add_option("--self", check.selves, "Meshes: hold this body against itself, too, or all; may be repeated")
      ->type_name("NAME|all")
      ->allow_extra_args(false);
}

}  // namespace

void view(const ViewCommandOptions& options, std::ostream& out) {
  check_use(options);
  const ViewOptions page = named_page(options);
  const std::string& first = options.what.front();
  const bool alone = options.what.size() == 1;
  std::error_code ignored;
  const bool exists = std::filesystem::exists(first, ignored);
  const Shown shown = alone && exists && is_recording(first)             ? Shown::recording
                      : alone && !exists && find_scene(first) != nullptr ? Shown::scene
                                                                         : Shown::meshes;
  check_is_used(options, shown);
  if (shown == Shown::recording) {
    view_recording(options, page, out);
  } else if (shown == Shown::scene) {
    view_scene(options, page, out);
  } else {
    view_meshes(options, page, out);
  }
  if (options.opens) open_page(page.file, out);
}

std::string page_of(const std::string& name) { return "tact-" + name + ".html"; }

void check_page_options(const ViewOptions& page) {
  if (page.to < page.from) throw UsageError(fmt::format("--to: {} is before --from {}", page.to, page.from));
}

void add_page_options(CLI::App& command, ViewOptions& page) {
  constexpr int kMost = std::numeric_limits<int>::max();
  command.add_option("--from", page.from, "The page shows steps from this one on, counted from 0")
      ->type_name("STEP")
      ->check(CLI::Range(0, kMost).description(""));
  command.add_option("--to", page.to, "The page shows steps up to this one")
      ->type_name("STEP")
      ->check(CLI::Range(0, kMost).description(""));
  command.add_flag(
      "--few-points", page.few_points,
      "Of each patch the page shows at most four contact points, which span it: pages of piles get smaller");
  command.add_option("--largest", page.largest, "How many megabytes the page may have; 400 if not given")
      ->type_name("MB")
      ->check(CLI::Range(1, kMost).description(""));
}

void add_view_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("view", "Write a page for the browser that plays a run and shows why facets were kept");
  const auto options = std::make_shared<ViewCommandOptions>();
  constexpr int kMost = std::numeric_limits<int>::max();
  command->footer(kViewExamples);
  command->add_option("WHAT", options->what, "A recording, meshes and folders of them, or a scene's name")
      ->type_name("")
      ->required();
  command->add_option("--out", options->page.file, "The page to write; tact-NAME.html if not given")
      ->type_name("FILE.html")
      ->check(refuse_empty_name);
  command->add_flag("--open", options->opens, "Show the page in the browser, too");
  command->add_option("--every", options->page.every, "Steps from one that the page shows to the next")
      ->type_name("N")
      ->check(CLI::Range(1, kMost).description(""));
  add_page_options(*command, options->page);
  command->add_option("--frames", options->frames, "Scenes and meshes: how many steps; of scenes 300 if not given")
      ->type_name("N")
      ->check(CLI::Range(1, kMost).description(""));
  command->add_option("--size", options->size, "Scenes: how large")
      ->type_name("N")
      ->check(CLI::Range(1, kMost).description(""));
  command->add_flag("--continuous", options->continuous, "Scenes: stop bodies before they meet");
  command->add_flag("--points", options->outputs.points,
                    "Compute and show contact points; of meshes with --margin they always are");
  command->add_flag("--curves", options->outputs.curves,
                    "Recordings and meshes: compute and show the curves in which surfaces cross");
  options->outputs.patches = true;  // they change no answer
  add_mesh_options(*command, options->check);
  add_accuracy_option(*command, options->accuracy);
  const auto threads = std::make_shared<int>(0);
  add_threads_option(*command, *threads);
  CLI::Option* given = command->get_option("--threads");
  add_json_option(*command, options->json);
  command->callback([options, threads, given] {
    if (given->count() > 0) options->threads = *threads;
    view(*options, std::cout);
  });
}

}  // namespace tact::scenes
