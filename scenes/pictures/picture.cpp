#include "scenes/pictures/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tact::scenes {

Color body_color(std::size_t index) {
  // Light and dark alternate.
  constexpr std::array<Color, 8> kColors{{{64, 118, 178},
                                          {236, 209, 160},
                                          {24, 138, 122},
                                          {205, 170, 205},
                                          {92, 96, 160},
                                          {150, 205, 232},
                                          {122, 132, 62},
                                          {200, 214, 190}}};
  // Lightness of the rounds after the first; the fourth round is the first again.
  constexpr std::array<double, 3> kLightness{1.0, 0.78, 1.18};
  const Color color = kColors[index % kColors.size()];
  const double lightness = kLightness[index / kColors.size() % kLightness.size()];
  const auto scaled = [lightness](std::uint8_t channel) {
    return static_cast<std::uint8_t>(std::lround(std::min(255.0, lightness * channel)));
  };
  return {scaled(color.red), scaled(color.green), scaled(color.blue)};
}

}  // namespace tact::scenes
