// Tells a program which limits a step reached, and what is wrong with a body that was added.
#pragma once

#include <tact/message.h>
#include <tact/report.h>

#include "engine/bodies/bodies.h"

namespace tact {

// Says what `report` says of limits, through `tell`. Costs nothing where none was reached.
void tell_limits(const Report& report, const Bodies& bodies, const MessageFunction& tell);

// Says what is wrong with the surface of a body that was added as closed: it is taken as a sheet, or it is inside out.
void tell_wrong_surface(const Body& body, const MessageFunction& tell);

}  // namespace tact
