#include "bench/commands.h"

#include "bench/error/error.h"
#include "bench/mpi/mpi.h"
#include "bench/predicates.h"
#include "bench/rivals/broadphase.h"
#include "bench/rivals/rivals.h"
#include "bench/scaling/busy.h"
#include "bench/scaling/calls.h"
#include "bench/scaling/clusters.h"
#include "bench/scaling/grains.h"
#include "bench/scaling/idle.h"
#include "bench/scaling/motion.h"
#include "bench/scaling/points.h"
#include "bench/scaling/queries.h"
#include "bench/scaling/refresh.h"
#include "bench/scaling/rigid.h"
#include "bench/scaling/scaling.h"
#include "bench/scaling/self.h"
#include "bench/scaling/solver.h"
#include "bench/scaling/stages.h"
#include "bench/stability/stability.h"

namespace tact::bench {

std::vector<Command> commands() {
  return {
      {"rivals", "the same frames through tact, Embree, CGAL, FCL and Bullet", run_rivals, true},
      {"refresh", "vertices a second of taking in new positions, against a plain sum", run_refresh},
      {"scaling", "one and more threads, growth with bodies and facets, the slowest of many steps", run_scaling},
      {"stages", "what each stage costs in every level of the cache, and on all threads", run_stages},
      {"idle", "steps in which nothing moved, or few of many", run_idle},
      {"calls", "changing one body of ever more", run_calls},
      {"busy", "steps beside programs that keep the processor busy", run_busy, true},
      {"motion", "what meets between two steps, against the inclusion-based method", run_motion, true},
      {"points", "contact points, against the same step without, and with Embree's and CGAL's boxes", run_points, true},
      {"self", "bodies against themselves, through tact, Embree and CGAL", run_self, true},
      {"solver", "substeps of solvers: margins, points and self-contact, against the same without", run_solver, true},
      {"rigid", "rigid bodies moved by poses, against the same moved by their vertices", run_rigid, true},
      {"queries", "rays and nearest points of a moving surface, through tact, Embree and FCL", run_queries, true},
      {"grains", "grains and ropes on a plane, ever more of them", run_grains},
      {"broadphase", "boxes alone, in every kind of motion, through tact, Embree and CGAL", run_broadphase},
      {"clusters", "pairs of clusters by a loop and by Embree's trees", run_clusters},
      {"error", "run time against error, of every setting and of other libraries", run_error},
      {"mpi", "worlds over 1 to 64 ranks of MPI: what they send and hold", run_mpi},
      {"predicates", "what a triangle test costs, and how often the exact path runs", run_predicates},
      {"stability", "hostile input of every kind: failures, which must be none", run_stability},
  };
}

}  // namespace tact::bench
