#include "scenes/pictures/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "engine/base/parallel.h"
#include "scenes/pictures/drawn_scene.h"
#include "scenes/pictures/painter.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kPixelRowsAtATime = 4;  // rows of pixels that a thread takes at a time

}  // namespace

Renderer::Renderer(const RenderSettings& settings) : settings_(settings) {
  if (settings.width < 1 || settings.height < 1) {
    throw std::runtime_error(fmt::format("a picture of {} x {} pixels", settings.width, settings.height));
  }
  if (settings_.threads <= 0) settings_.threads = base::default_threads();
}

Picture Renderer::render(const PictureScene& scene, const Camera& camera) {
  const DrawnScene drawn = drawn_scene(scene, camera, settings_.threads);
  Painter painter(drawn, settings_.width, settings_.height, settings_.quality == Quality::draft ? 1 : 4);
  Picture picture(settings_.width, settings_.height);
  const auto for_each_pixel = [&](const auto& visit) {
    base::parallel_for(static_cast<std::size_t>(picture.height), kPixelRowsAtATime, settings_.threads,
                       [&](std::size_t row) {
                         for (int x = 0; x < picture.width; ++x) visit(x, static_cast<int>(row));
                       });
  };
  for_each_pixel([&](int x, int y) { painter.light(x, y); });
  painter.smooth_light(settings_.threads);
  for_each_pixel([&](int x, int y) { painter.sketch(x, y); });
  for_each_pixel([&](int x, int y) { picture.at(x, y) = painter.color(x, y); });
  const int size = std::max(9, picture.height / 30);
  font_.draw(picture, scene.title, size, 2 * size, size + size / 4, kInk);
  font_.draw(picture, scene.caption, size, picture.height - size, size - size / 6, kInk);
  return picture;
}

Picture Renderer::render(const PictureScene& scene) {
  return render(scene, framing(shown_points(scene), scene.up, settings_.width, settings_.height));
}

}  // namespace tact::scenes
