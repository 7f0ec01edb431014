#include "bench/rival.h"

namespace tact::bench {

std::vector<RivalKind> all_rivals() {
  return {
      {"Embree, a scene a body", make_embree_scene_a_body},
      {"Embree, one scene", make_embree_one_scene},
      {"CGAL, boxes", make_cgal_boxes},
      {"CGAL, clipped boxes", make_cgal_clipped},
      {"FCL, AABB", make_fcl_aabb},
      {"FCL, OBBRSS", make_fcl_obbrss},
      {"Bullet, GImpact", make_bullet_gimpact},
      {"FCL, own triangle test", make_fcl_own_test, false},
  };
}

}  // namespace tact::bench
