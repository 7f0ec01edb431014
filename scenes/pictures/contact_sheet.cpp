#include "scenes/pictures/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "scenes/pictures/drawn_scene.h"

namespace tact::scenes {
namespace {

constexpr Color kPaper{252, 252, 251};

void check(std::span<const Picture> pictures, std::span<const std::string> captions, const SheetSettings& settings) {
  if (pictures.empty()) throw std::runtime_error("a contact sheet of no pictures");
  if (captions.size() != pictures.size()) {
    throw std::runtime_error(
        fmt::format("a contact sheet of {} pictures with {} captions", pictures.size(), captions.size()));
  }
  for (const Picture& picture : pictures) {
    if (picture.width != pictures[0].width || picture.height != pictures[0].height) {
      throw std::runtime_error("a contact sheet of pictures that differ in size");
    }
  }
  if (settings.columns < 1 || settings.gap < 0 || settings.tile_width < 1 || settings.tile_width > pictures[0].width) {
    throw std::runtime_error(fmt::format("a contact sheet of {} columns of {} pixels with gaps of {}", settings.columns,
                                         settings.tile_width, settings.gap));
  }
}

// The mean light of the part of `picture` that pixel (x, y) of the smaller picture covers.
Light covered(const Picture& picture, const Picture& smaller, int x, int y) {
  const auto part = [](int i, int from, int to) { return static_cast<double>(i) * from / to; };
  const double left = part(x, picture.width, smaller.width);
  const double right = part(x + 1, picture.width, smaller.width);
  const double top = part(y, picture.height, smaller.height);
  const double bottom = part(y + 1, picture.height, smaller.height);
  Light sum = Light::Zero();
  for (int v = static_cast<int>(top); v < std::min<double>(bottom, picture.height); ++v) {
    for (int u = static_cast<int>(left); u < std::min<double>(right, picture.width); ++u) {
      const double across = std::min(right, u + 1.0) - std::max<double>(left, u);
      const double down = std::min(bottom, v + 1.0) - std::max<double>(top, v);
      sum += static_cast<float>(across * down) * linear(picture.at(u, v));
    }
  }
  return sum / static_cast<float>((right - left) * (bottom - top));
}

Picture scaled_down(const Picture& picture, int width, int height) {
  Picture smaller(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) smaller.at(x, y) = displayed(covered(picture, smaller, x, y));
  }
  return smaller;
}

}  // namespace

std::vector<int> sheet_frames(int frames, int count) {
  const int shown = std::clamp(count, 0, std::max(frames, 0));
  std::vector<int> result;
  for (int i = 0; i < shown; ++i) {
    result.push_back(shown == 1 ? frames - 1
                                : static_cast<int>((2LL * i * (frames - 1) + shown - 1) / (2 * (shown - 1))));
  }
  return result;
}

Picture contact_sheet(std::span<const Picture> pictures, std::span<const std::string> captions, Font& font,
                      const SheetSettings& settings) {
  check(pictures, captions, settings);
  const int columns = std::min(settings.columns, static_cast<int>(pictures.size()));
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  const int tile_height = std::max(1, settings.tile_width * pictures[0].height / pictures[0].width);
  const int letters = std::max(10, settings.tile_width / 32);
  const int caption_height = 2 * letters;
  const int step_x = settings.tile_width + settings.gap;
  const int step_y = tile_height + caption_height + settings.gap;
  Picture sheet(columns * step_x + settings.gap, rows * step_y + settings.gap, kPaper);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int left = settings.gap + static_cast<int>(i) % columns * step_x;
    const int top = settings.gap + static_cast<int>(i) / columns * step_y;
    const Picture tile = scaled_down(pictures[i], settings.tile_width, tile_height);
    for (int y = 0; y < tile_height; ++y) {
      std::copy_n(&tile.at(0, y), tile.width, &sheet.at(left, top + y));
    }
    font.draw(sheet, captions[i], left, top + tile_height + letters + letters / 3, letters, kInk);
  }
  return sheet;
}

}  // namespace tact::scenes
