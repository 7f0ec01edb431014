// Contacts as JSON lines, an object a step:
//
//   {"frame":12,"time":0.2,"contacts":[{"a":0,"b":3,"names":["bowl","ball#2"],"direction":[x,y,z],"depth":d,
//    "source":"carried","facet_pairs":[[fa,fb],...]},...]}
//
// `contacts` are the pairs whose hulls overlap, sorted by (a, b); the direction points from a to b, the depth is in
// metres, the time in seconds. At Accuracy::hulls, which looks at no facets, all "facet_pairs" are empty. Numbers read
// back to the same double. In names, U+FFFD stands for bytes that are not UTF-8.
#pragma once

#include <tact/report.h>
#include <tact/world.h>

#include <ostream>

namespace tact::scenes {

// Writes one line; the bodies of `report` must still be in `world`.
void write_contact_line(std::ostream& out, int frame, double time, const World& world, const Report& report);

}  // namespace tact::scenes
