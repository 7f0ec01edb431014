#include "bench/commands.h"

#include "bench/error.h"
#include "bench/rivals.h"
#include "bench/stability.h"

namespace tact::bench {

std::vector<Command> commands() {
  return {
      {"rivals", "the same frames through tact, Embree, CGAL, FCL and Bullet", run_rivals},
      {"error", "run time against error, of every setting and of other libraries", run_error},
      {"stability", "hostile input of every kind: failures, which must be none", run_stability},
  };
}

}  // namespace tact::bench
