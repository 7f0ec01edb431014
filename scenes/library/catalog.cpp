#include "scenes/library/catalog.h"

#include <algorithm>
#include <array>

namespace tact::scenes {
namespace {

constexpr std::array kScenes = {
    SceneEntry{"cloth-over-sphere", "a cloth falls on a sphere and drapes in folds",
               "vertices along a side of the cloth", 64, 8, 512, make_cloth_over_sphere},
    SceneEntry{"pile", "soft bodies of several shapes, some concave, fall into a bin", "soft bodies", 100, 1, 4000,
               make_pile},
};

}  // namespace

std::span<const SceneEntry> scene_catalog() { return kScenes; }

const SceneEntry* find_scene(std::string_view name) {
  const auto found = std::find_if(kScenes.begin(), kScenes.end(), [&](const SceneEntry& s) { return s.name == name; });
  return found == kScenes.end() ? nullptr : &*found;
}

}  // namespace tact::scenes
