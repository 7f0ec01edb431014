// Pictures of a running scene: a PNG file a picture, and a sheet of six of them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "scenes/library/scene.h"
#include "scenes/pictures/camera.h"
#include "scenes/pictures/renderer.h"

namespace tact::scenes {

class ScenePictures {
 public:
  // Creates `folder` and takes away the frames of an older run. Pictures are named `title`. Errors: FileError;
  // std::runtime_error if the font is missing.
  ScenePictures(std::string title, const Scene& scene, std::filesystem::path folder, int threads);

  // Writes the next picture. Errors: std::runtime_error if it cannot be written.
  void take(const Simulation& simulation);
  // Makes a film of all pictures, FOLDER/film.mp4 or .webp, and returns its file. Errors: as make_film.
  std::filesystem::path write_film() const;
  // Writes a sheet of six pictures, evenly spread, and returns its file; nothing if no picture was taken.
  std::optional<std::filesystem::path> write_sheet();

  int count() const { return static_cast<int>(captions_.size()); }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  PictureScene picture_scene(const Simulation& simulation) const;

  std::string title_;
  std::vector<Look> looks_;
  ContactMarks marks_;
  std::optional<double> ground_;
  std::filesystem::path folder_;
  Renderer renderer_;
  std::optional<Camera> camera_;
  View view_;
  std::optional<base::Box> shown_;
  std::vector<std::string> captions_;
};

// The bodies as a picture shows them, in their colours, invisible ones included.
std::vector<PictureBody> picture_bodies(const Simulation& simulation, const std::vector<Look>& looks);

}  // namespace tact::scenes
