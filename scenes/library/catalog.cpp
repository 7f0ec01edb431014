#include "scenes/library/catalog.h"

#include <algorithm>
#include <array>

namespace tact::scenes {
namespace {

constexpr std::array kScenes = {
    SceneEntry{"cloth-over-sphere", "a cloth falls on a sphere and drapes in folds",
               "vertices along a side of the cloth", 64, 8, 512, make_cloth_over_sphere},
    SceneEntry{"sphere-into-cloth", "a sphere rises into a cloth that hangs from its corners",
               "vertices along a side of the cloth", 64, 8, 512, make_sphere_into_cloth},
    SceneEntry{"pile", "bodies of several shapes, some concave, a third rigid, fall into a bin", "bodies", 100, 1, 4000,
               make_pile},
    SceneEntry{"bullets", "small fast bodies hit thin sheets; they pass through unless --continuous is given",
               "bullets", 6, 1, 100, make_bullets},
    SceneEntry{"clamp", "a ball is held from two opposite sides by one body and lifted", "", 0, 0, 0, make_clamp},
    SceneEntry{"liver-and-tool", "a tool pokes a concave soft organ of 500 facets", "", 0, 0, 0, make_liver_and_tool},
    SceneEntry{"sphere-in-cloth", "a sphere sinks into a slack cloth and leaves it the way it came",
               "vertices along a side of the cloth", 48, 16, 256, make_sphere_in_cloth},
    SceneEntry{"wheel-on-ground", "a soft wheel rolls over hilly ground that is far larger", "cells along the ground",
               300, 50, 1000, make_wheel_on_ground},
    SceneEntry{"cloth-fold", "a sheet on a table is folded over four times, into five layers",
               "vertices along a side of the sheet", 40, 16, 160, make_cloth_fold},
    SceneEntry{"ribbon-knot", "a loose knot in a ribbon is pulled tight by its ends", "vertices along the ribbon", 160,
               100, 500, make_ribbon_knot},
    SceneEntry{"net", "a net of ropes over a floor catches grains and a cloth", "meshes along a side of the net", 12, 4,
               40, make_net},
    SceneEntry{"surgery", "a membrane over an organ is cut along a blade and tears; a thread falls through the cut",
               "vertices along a side of the membrane", 21, 11, 61, make_surgery},
};

}  // namespace

std::span<const SceneEntry> scene_catalog() { return kScenes; }

const SceneEntry* find_scene(std::string_view name) {
  const auto found = std::find_if(kScenes.begin(), kScenes.end(), [&](const SceneEntry& s) { return s.name == name; });
  return found == kScenes.end() ? nullptr : &*found;
}

}  // namespace tact::scenes
