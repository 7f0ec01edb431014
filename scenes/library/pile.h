// The bodies of the pile one by one, for programs that hold a part of it.
#pragma once

#include <vector>

#include "scenes/dynamics/body.h"
#include "scenes/dynamics/dynamics_settings.h"
#include "scenes/library/random.h"

namespace tact::scenes {

// Where bodies are before they fall: `side` times `side` places a layer.
struct PileGrid {
  int side = 0;
  int layers = 0;
  double half = 0.0;  // of the width of all, metres
};

// Of so many bodies: twice as wide as high, or as wide as it takes for no more than `most_layers`.
PileGrid pile_grid(int size, double most_layers);
// The floor first, then four walls; fixed.
std::vector<Body> pile_bin(const PileGrid& grid);
enum class PileBody { soft, rigid };
// Body `number` at a place of the grid: its shape, how it is turned and where in its place it is are random.
Body pile_body(int number, int place, const PileGrid& grid, PileBody kind, Random& random);
DynamicsSettings pile_dynamics();

}  // namespace tact::scenes
