// The states of bodies and the contacts of all ranks as JSON lines, an object a frame:
//
//   {"frame":12,"time":0.054,"kinetic_energy":1.7,"awake":98,"asleep":2,"contacts":150,"contact_points":512,
//    "facet_pairs":0,"detections":1,"smallest_gap":0.0057,"bodies":[
//    {"key":0,"name":"bowl 0","asleep":false,"middle":[x,y,z],"positions":[x,y,z,x,...]},...
//    ],"pairs":[
//    {"a":0,"b":17,"touching":true,"facet_pairs":0,"points":4,"gap":0.0057,"hash":"0123456789abcdef"},...
//    ]}
//
// Bodies and pairs stand in the order of keys, a line each. "middle" is the mean of the vertices, "gap" the smallest of
// the points, or null; "hash" that of tact::Contact::hash(). Numbers read back to the same double. The bytes are the
// same for any number of ranks.
#pragma once

#include "mpi/program/ordered_file.h"
#include "mpi/program/pile_simulation.h"

namespace tact::mpi::program {

enum class Vertices { left_out, written };

// Appends the frame, together.
void append_frame(OrderedFile& file, int frame, const PileSimulation& pile, Vertices vertices);

}  // namespace tact::mpi::program
