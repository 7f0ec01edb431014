#include "scenes/commands/run_outputs.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>

#include "scenes/export/contact_lines.h"
#include "scenes/export/state_lines.h"
#include "scenes/pictures/film.h"

namespace tact::scenes {
namespace {

// Pictures play at half the speed of the scene at 30 a second.
int steps_a_frame(const DynamicsSettings& dynamics) {
  constexpr double kFramesASecond = 60.0;  // of the scene
  return std::max(1, static_cast<int>(std::lround(1.0 / (kFramesASecond * dynamics.time_step))));
}

}  // namespace

RunOutputs::RunOutputs(const OutputOptions& options, const std::string& title, const Scene& scene, const World& world,
                       int threads, std::ostream& out)
    : options_(options),
      looks_(scene.looks),
      every_(options.every > 0 ? options.every : steps_a_frame(scene.dynamics)) {
  if (!options.json.empty()) {
    json_file_.emplace(options.json, out);
    json_.emplace(json_file_->stream(), world,
                  options.view.file.empty() ? JsonReport::Outcomes::none : JsonReport::Outcomes::counts);
  }
  if (!options.contacts.empty()) contacts_.emplace(options.contacts, out, Appears::at_once);
  if (!options.states.empty()) states_.emplace(options.states, out, Appears::at_once);
  if (!options.trace.empty()) {
    trace_file_.emplace(options.trace, out);
    trace_.emplace(trace_file_->stream(), title, threads);
  }
  if (!options.gltf.empty()) {
    gltf_file_.emplace(options.gltf.string(), out);
    gltf_.emplace(UpAxis::z);
  }
  if (!options.vtk.empty()) vtk_.emplace(options.vtk, title);
  if (!options.view.file.empty()) {
    page_.emplace(options.view, ViewTitle{.name = title, .kind = "scene"}, out);
    std::vector<double> opacities;
    for (const Look& look : looks_) opacities.push_back(look.visible ? look.opacity : 0.0);
    page_->set_opacities(std::move(opacities));
  }
  // Last, as it takes an older run's pictures away.
  if (options.pictures) {
    pictures_.emplace(title, scene, options.out.empty() ? std::filesystem::path("tact-" + title) : options.out,
                      threads);
  }
}

void RunOutputs::add_step(int step, const Simulation& simulation) {
  if (json_) json_->add_frame(step, *simulation.report());
  if (contacts_) {
    write_contact_line(contacts_->stream(), step, simulation.state().time, simulation.world(), *simulation.report());
  }
  if (states_) write_state_line(states_->stream(), step, simulation);
  if (trace_) trace_->add_step(step, simulation);
  if (page_) page_->add_step(step, simulation.state().time, simulation.world(), *simulation.report());
  if (step % every_ == 0) add_frame(simulation);
}

void RunOutputs::add_frame(const Simulation& simulation) {
  if (pictures_) pictures_->take(simulation);
  if (!gltf_ && !vtk_) return;
  const std::vector<PictureBody> bodies = visible_bodies(simulation);
  if (gltf_) gltf_->add_frame(bodies, simulation.state().time);
  if (vtk_) vtk_->write(bodies, simulation.state().time);
}

std::vector<PictureBody> RunOutputs::visible_bodies(const Simulation& simulation) const {
  std::vector<PictureBody> bodies = picture_bodies(simulation, looks_);
  PictureScene marked;
  marked.bodies = std::move(bodies);
  mark_contacts(marked, *simulation.report(), {.directions = false});
  bodies.clear();
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (looks_[i].visible) bodies.push_back(std::move(marked.bodies[i]));
  }
  return bodies;
}

void RunOutputs::finish(Ending ending, Failures& failures) {
  if (json_) {
    failures.attempt([&] {
      json_->finish(ending);
      json_file_->finish();
    });
  }
  if (contacts_) failures.attempt([&] { contacts_->finish(); });
  if (states_) failures.attempt([&] { states_->finish(); });
  if (vtk_) made_.push_back(fmt::format("frames for ParaView: {}", vtk_->index_file().string()));
  if (gltf_ && gltf_->frames() > 0) {
    failures.attempt([&] {
      gltf_->write(gltf_file_->stream());
      gltf_file_->finish();
      made_.push_back(fmt::format("frames for Blender: {}", options_.gltf.string()));
    });
  }
  if (trace_) {
    failures.attempt([&] {
      trace_->finish();
      trace_file_->finish();
      made_.push_back(fmt::format("trace for ui.perfetto.dev: {}", options_.trace));
    });
  }
  if (page_) {
    failures.attempt([&] {
      page_->finish(ending);
      made_.push_back("page for the browser: " + page_->summary());
    });
  }
  if (pictures_ && pictures_->count() > 0) finish_pictures(failures);
}

void RunOutputs::finish_pictures(Failures& failures) {
  made_.push_back(fmt::format("{} pictures: {}", pictures_->count(), pictures_->folder().string()));
  failures.attempt([&] { made_.back() += fmt::format(", a sheet of them: {}", pictures_->write_sheet()->string()); });
  failures.attempt([&] {
    try {
      made_.push_back(fmt::format("film: {}", pictures_->write_film().string()));
    } catch (const NoEncoder& error) {
      made_.emplace_back(error.what());
    }
  });
}

void RunOutputs::print(std::ostream& out) const {
  for (const std::string& line : made_) fmt::print(out, "{}\n", line);
}

}  // namespace tact::scenes
