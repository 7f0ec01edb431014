#include "film.h"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

#include "scenes/pictures/camera.h"
#include "scenes/pictures/contact_sheet.h"
#include "scenes/pictures/film.h"
#include "scenes/pictures/png_file.h"
#include "scenes/pictures/renderer.h"

namespace example {
namespace {

namespace pictures = tact::scenes;

constexpr int kEvery = 20;     // steps from a frame to the next: 12 frames a second
constexpr int kTile = 400;     // pixels
constexpr int kSheetRows = 3;  // of the sheet, times of the film

struct Played {
  std::string title;
  std::vector<pictures::Picture> frames;
  std::vector<std::string> times;
};

pictures::PictureScene picture_scene(const Scene& scene, const std::string& title) {
  pictures::PictureScene picture;
  picture.up = pictures::UpAxis::z;
  picture.ground = 0.0;
  picture.title = title;
  std::size_t color = 0;
  for (const SceneBody& body : scene.bodies()) {
    if (body.name == "ground") continue;
    pictures::PictureBody& shown = picture.bodies.emplace_back();
    shown.positions = scene.positions(body);
    shown.facets = body.mesh.facets;
    shown.color = pictures::body_color(color++);
  }
  return picture;
}

}  // namespace

struct Film::Implementation {
  std::filesystem::path folder;
  pictures::Renderer renderer{{.width = kTile, .height = kTile}};
  pictures::Font font;
  std::optional<pictures::Camera> camera;
  std::vector<Played> played;
};

Film::Film(const std::string& folder) {
  if (folder.empty()) return;
  implementation_ = std::make_unique<Implementation>();
  implementation_->folder = folder;
  std::filesystem::create_directories(folder);
}

Film::~Film() = default;

void Film::begin(const std::string& title) {
  if (implementation_) implementation_->played.push_back({title, {}, {}});
}

void Film::look(const Scene& scene, int step) {
  if (!implementation_ || step % kEvery != 0) return;
  Played& played = implementation_->played.back();
  const pictures::PictureScene picture = picture_scene(scene, "");
  if (!implementation_->camera) {  // one for all, so that the film is still
    const tact::base::Box room{{-0.6, -0.6, 0.0}, {0.6, 0.6, 1.55}};
    implementation_->camera = pictures::framing(room, picture.up, kTile, kTile, {.azimuth = 30.0, .elevation = 12.0});
  }
  char time[32];
  std::snprintf(time, sizeof time, "%.2f s", step * kStep);
  played.frames.push_back(implementation_->renderer.render(picture, *implementation_->camera));
  played.times.push_back(played.title + ", " + time);
}

void Film::end() {
  if (!implementation_) return;
  const std::vector<Played>& played = implementation_->played;
  const int frames = static_cast<int>(played.front().frames.size());
  const pictures::SheetSettings settings{.columns = static_cast<int>(played.size()), .tile_width = kTile};
  const auto beside_each_other = [&](const std::vector<int>& which) {
    std::vector<pictures::Picture> tiles;
    std::vector<std::string> captions;
    for (const int frame : which) {
      for (const Played& way : played) {
        tiles.push_back(way.frames[frame]);
        captions.push_back(way.times[frame]);
      }
    }
    return pictures::contact_sheet(tiles, captions, implementation_->font, settings);
  };
  const std::filesystem::path& folder = implementation_->folder;
  for (int i = 0; i < frames; ++i) pictures::write_png(pictures::frame_file(folder, i), beside_each_other({i}));
  pictures::write_png(folder / "sheet.png", beside_each_other(pictures::sheet_frames(frames, kSheetRows)));
  try {
    std::printf("%s\n", pictures::make_film(folder, frames, folder / "film", {.frames_per_second = 12}).c_str());
  } catch (const pictures::NoEncoder& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
}

}  // namespace example
