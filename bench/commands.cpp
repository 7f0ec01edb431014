#include "bench/commands.h"

namespace tact::bench {

std::vector<Command> commands() { return {}; }

}  // namespace tact::bench
