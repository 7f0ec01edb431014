// A picture in memory, and colours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tact::scenes {

// A colour as it is shown: sRGB, 0 to 255 a channel.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  friend bool operator==(const Color&, const Color&) = default;
};

inline constexpr Color kInk{38, 44, 54};  // of text

// Rows from the top, pixels from the left.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;  // width * height

  Picture() = default;
  Picture(int width_, int height_, Color fill = {})
      : width(width_),
        height(height_),
        pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), fill) {}

  const Color& at(int x, int y) const { return pixels[index(x, y)]; }
  Color& at(int x, int y) { return pixels[index(x, y)]; }
  friend bool operator==(const Picture&, const Picture&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

// The colour of the body with this index. Neighbouring indices differ in lightness as well as in hue, so that they stay
// apart for colour-blind eyes; red and orange are left to what meets. From the ninth body on, shades of the first
// eight.
Color body_color(std::size_t index);

inline constexpr Color kMeetingColor{255, 62, 20};     // facets that meet
inline constexpr Color kDirectionColor{255, 205, 25};  // contact directions
inline constexpr Color kZoneColor{20, 225, 235};       // impact zones

}  // namespace tact::scenes
