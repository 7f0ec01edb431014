// What `tact check --surfaces` says of each body's surface.
#pragma once

#include <tact/world.h>

#include <ostream>

#include "scenes/commands/json_text.h"

namespace tact::scenes {

// Of one body: {"solid":true,"components":[{"facet":0,"facets":12,"closed":true,"inside_out":false},...],
// "border_edges":[[v,w],...],"branching_edges":[...],"turned_facets":[f,...],"crossings":[[f,g],...],
// "repeated_facets":[[f,g],...],"repeated_vertices":[[v,w],...],"slivers":[f,...],"unused_vertices":[v,...]}
Json surface_json(const SurfaceCheck& check);

// Prints what was found of each body, a line a fault with its first places.
void print_surfaces(std::ostream& out, const World& world);

}  // namespace tact::scenes
