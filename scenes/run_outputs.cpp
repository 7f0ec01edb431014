#include "scenes/run_outputs.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>

#include "scenes/export/contact_lines.h"
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
  if (options.pictures) {
    pictures_.emplace(title, scene, options.out.empty() ? std::filesystem::path("tact-" + title) : options.out,
                      threads);
  }
  if (!options.json.empty()) {
    json_file_.emplace(options.json, out);
    json_.emplace(json_file_->stream(), world);
  }
  if (!options.contacts.empty()) contacts_.emplace(options.contacts, out);
  if (!options.trace.empty()) {
    trace_file_.emplace(options.trace, out);
    trace_.emplace(trace_file_->stream(), title, threads);
  }
  if (!options.gltf.empty()) gltf_.emplace(UpAxis::z);
  if (!options.vtk.empty()) vtk_.emplace(options.vtk, title);
}

void RunOutputs::add_step(int step, const Simulation& simulation) {
  if (json_) json_->add_frame(step, *simulation.report());
  if (contacts_) {
    write_contact_line(contacts_->stream(), step, simulation.state().time, simulation.world(), *simulation.report());
  }
  if (trace_) trace_->add_step(step, simulation);
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

void RunOutputs::finish() {
  if (json_) json_->finish();
  if (json_file_) json_file_->finish();
  if (contacts_) contacts_->finish();
  if (trace_) trace_->finish();
  if (trace_file_) trace_file_->finish();
  if (gltf_ && gltf_->frames() > 0) gltf_->write(options_.gltf);
  if (!pictures_ || pictures_->count() == 0) return;
  sheet_ = pictures_->write_sheet();
  try {
    film_ = fmt::format("film: {}", pictures_->write_film().string());
  } catch (const NoEncoder& error) {
    film_ = error.what();
  }
}

void RunOutputs::print(std::ostream& out) const {
  if (vtk_) fmt::print(out, "frames for ParaView: {}\n", vtk_->index_file().string());
  if (gltf_ && gltf_->frames() > 0) fmt::print(out, "frames for Blender: {}\n", options_.gltf.string());
  if (trace_) fmt::print(out, "trace for ui.perfetto.dev: {}\n", options_.trace);
  if (!sheet_) return;
  fmt::print(out, "{} pictures: {}, a sheet of them: {}\n{}\n", pictures_->count(), pictures_->folder().string(),
             sheet_->string(), film_);
}

}  // namespace tact::scenes
