// What a step found, as the page reads it.
#pragma once

#include <tact/report.h>

#include <functional>

#include "scenes/view/view_bytes.h"

namespace tact::scenes {

// The place of a body in the page.
using PlaceInView = std::function<std::size_t(BodyId)>;

// All contact points, or of each patch at most four that span it.
enum class PointsInView { all, spanning };

// Appends the candidate pairs and the contacts of `report`. viewer/src/chunk.js reads them in the same order.
void write_contacts(const Report& report, const PlaceInView& place, PointsInView points, ViewBytes& out);

}  // namespace tact::scenes
