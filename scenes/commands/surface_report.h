// What `tact check --surfaces` says of each body's surface.
#pragma once

#include <tact/world.h>

#include <ostream>

#include "scenes/commands/json_text.h"

namespace tact::scenes {

// Of one body; docs/pages/json.md tells the form.
Json surface_json(const SurfaceCheck& check);

// Prints what was found of each body, a line a fault with its first places.
void print_surfaces(std::ostream& out, const World& world);

}  // namespace tact::scenes
