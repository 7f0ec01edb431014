// The report of a step as the engine makes it: with where the answers came from.
#pragma once

#include <tact/report.h>
#include <tact/settings.h>

namespace tact {

class Bodies;
class PairTable;

// Every report of a world is one. What it points to is the world's.
struct StepReport : Report {
  const Bodies* bodies = nullptr;
  PairTable* table = nullptr;
  const Settings* settings = nullptr;
};

}  // namespace tact
