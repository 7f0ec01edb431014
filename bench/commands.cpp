#include "bench/commands.h"

#include "bench/stability.h"

namespace tact::bench {

std::vector<Command> commands() {
  return {
      {"stability", "hostile input of every kind: failures, which must be none", run_stability},
  };
}

}  // namespace tact::bench
