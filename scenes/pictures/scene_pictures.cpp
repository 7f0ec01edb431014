#include "scenes/pictures/scene_pictures.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "scenes/commands/counted.h"
#include "scenes/files/file_error.h"
#include "scenes/pictures/contact_marks.h"
#include "scenes/pictures/contact_sheet.h"
#include "scenes/pictures/film.h"
#include "scenes/pictures/png_file.h"
#include "scenes/pictures/thick_lines.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kManyBodies = 12;

// Frames of a longer run before would end in this run's film.
void remove_old_frames(const std::filesystem::path& folder) {
  for (int frame = 0; std::filesystem::remove(frame_file(folder, frame)); ++frame) {
  }
}

}  // namespace

std::vector<PictureBody> picture_bodies(const Simulation& simulation, const std::vector<Look>& looks) {
  std::vector<PictureBody> bodies;
  std::size_t color = 0;
  for (std::size_t i = 0; i < simulation.bodies().size(); ++i) {
    const Body& body = simulation.bodies()[i];
    PictureBody& shown = bodies.emplace_back();
    shown.name = body.name;
    shown.positions = as_matrix(body.positions);
    shown.facets = body.facets;
    add_thick_lines(body.edges, body.grains, body.thickness, shown);
    shown.opacity = looks[i].opacity;
    shown.shading = looks[i].shading;
    if (looks[i].visible) shown.color = body_color(color++);
  }
  return bodies;
}

ScenePictures::ScenePictures(std::string title, const Scene& scene, std::filesystem::path folder, int threads)
    : title_(std::move(title)),
      looks_(scene.looks),
      marks_(scene.marks),
      ground_(scene.ground),
      folder_(std::move(folder)),
      renderer_({.threads = threads}),
      view_(scene.view),
      shown_(scene.shown) {
  marks_.directions = marks_.directions && looks_.size() < kManyBodies;
  try {
    std::filesystem::create_directories(folder_);
    remove_old_frames(folder_);
  } catch (const std::filesystem::filesystem_error& error) {
    throw FileError(fmt::format("{}: cannot be written: {}", folder_.string(), error.code().message()));
  }
}

PictureScene ScenePictures::picture_scene(const Simulation& simulation) const {
  PictureScene scene;
  scene.bodies = picture_bodies(simulation, looks_);
  scene.up = UpAxis::z;
  scene.ground = ground_;
  scene.facets_shine = looks_.size() < kManyBodies;
  scene.title = title_;
  if (simulation.report() != nullptr) mark_contacts(scene, *simulation.report(), marks_);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (!looks_[i].visible || !looks_[i].marked) scene.bodies[i].meeting_facets.clear();
    if (!looks_[i].visible) scene.bodies[i].facets.resize(3, 0);
  }
  return scene;
}

void ScenePictures::take(const Simulation& simulation) {
  PictureScene scene = picture_scene(simulation);
  const RenderSettings& settings = renderer_.settings();
  // One camera for all pictures keeps the film still.
  if (!camera_) {
    const base::Box box = shown_ ? *shown_ : bounding_box(scene);
    camera_ = framing(box, UpAxis::z, settings.width, settings.height, view_);
  }
  keep_arrows_in_picture(*camera_, settings.width, settings.height, scene);
  std::string caption = fmt::format("{:.2f} s", simulation.state().time);
  if (simulation.report() != nullptr) {
    const StepStats& stats = simulation.report()->stats();
    caption += fmt::format("   {}   {}", counted(stats.contacts, "contact"),
                           counted(simulation.state().contact_points, "contact point"));
  }
  scene.caption = caption;
  write_png(frame_file(folder_, count()), renderer_.render(scene, *camera_));
  captions_.push_back(std::move(caption));
}

std::filesystem::path ScenePictures::write_film() const { return make_film(folder_, count(), folder_ / "film"); }

std::optional<std::filesystem::path> ScenePictures::write_sheet() {
  if (captions_.empty()) return std::nullopt;
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
  for (const int frame : sheet_frames(count())) {
    pictures.push_back(read_png(frame_file(folder_, frame)));
    captions.push_back(captions_[frame]);
  }
  Font font;
  const std::filesystem::path file = folder_ / "sheet.png";
  write_png(file, contact_sheet(pictures, captions, font));
  return file;
}

}  // namespace tact::scenes
