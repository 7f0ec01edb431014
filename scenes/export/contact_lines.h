// Contacts as JSON lines, an object a step; docs/pages/json.md tells the form.
#pragma once

#include <tact/report.h>
#include <tact/world.h>

#include <ostream>

namespace tact::scenes {

// Writes one line; the bodies of `report` must still be in `world`.
void write_contact_line(std::ostream& out, int frame, double time, const World& world, const Report& report);

}  // namespace tact::scenes
