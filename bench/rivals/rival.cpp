#include "bench/rivals/rival.h"

namespace tact::bench {

std::vector<RivalKind> all_rivals() {
  return {
      {"Embree, a scene a body", make_embree_scene_a_body},
      {"Embree, one scene", make_embree_one_scene},
      {"CGAL, boxes", make_cgal_boxes},
      {"CGAL, clipped boxes", make_cgal_clipped},
      {"FCL, AABB", make_fcl_aabb},
      {"Bullet, GImpact", make_bullet_gimpact},
      {"Embree, a scene a body, plain", make_embree_scene_a_body_plain, false},
      {"CGAL, clipped boxes, plain", make_cgal_clipped_plain, false},
      {"FCL, OBBRSS", make_fcl_obbrss, false},  // its boxes are not rounded outward: a few pairs are lost
      {"FCL, own triangle test", make_fcl_own_test, false},
  };
}

}  // namespace tact::bench
