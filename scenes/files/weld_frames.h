// Welds bodies from files.
#pragma once

#include "scenes/files/body_files.h"

namespace tact::scenes {

// Makes one vertex of those that have equal positions in every frame, and counts them. Facets keep their numbers.
void weld_frames(BodyFrames& body);

}  // namespace tact::scenes
