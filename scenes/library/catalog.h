// The scenes that there are.
#pragma once

#include <span>
#include <string_view>

#include "scenes/library/scene.h"

namespace tact::scenes {

struct SceneEntry {
  std::string_view name;
  std::string_view summary;       // what is to be seen, a line
  std::string_view size_meaning;  // what --size counts; empty: the scene has one size
  int default_size = 0;
  int smallest_size = 0;
  int largest_size = 0;
  Scene (*make)(int size) = nullptr;
};

// In the order in which they are listed.
std::span<const SceneEntry> scene_catalog();
// The scene of this name; null if there is none.
const SceneEntry* find_scene(std::string_view name);

// The scenes; `size` within the limits of the catalog. Each says in its source what it is made of.
Scene make_cloth_over_sphere(int size);
Scene make_sphere_into_cloth(int size);
Scene make_pile(int size);
Scene make_bullets(int size);
Scene make_clamp(int size);
Scene make_liver_and_tool(int size);
Scene make_sphere_in_cloth(int size);
Scene make_wheel_on_ground(int size);
Scene make_cloth_fold(int size);
Scene make_ribbon_knot(int size);
Scene make_net(int size);
Scene make_surgery(int size);

}  // namespace tact::scenes
