// Tells a program which limits a step reached.
#pragma once

#include <tact/message.h>
#include <tact/report.h>

#include "engine/bodies/bodies.h"

namespace tact {

// Says what `report` says of limits, through `tell`. Costs nothing where none was reached.
void tell_limits(const Report& report, const Bodies& bodies, const MessageFunction& tell);

}  // namespace tact
