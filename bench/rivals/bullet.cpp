// Bullet. Its manual sends two moving concave meshes to GImpact, whose boxes are refitted after the vertices were
// changed. Bullet's own shape stores them in 16 bits relative to the body's first box and clamps what leaves it; the
// same module's hierarchy of unquantized boxes does not, so that one is used. Bodies are paired by btDbvtBroadphase.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/Gimpact/btGImpactBvh.h>

#include "bench/meeting_lists.h"
#include "bench/rivals/rival.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

// The facets of a body, as GImpact asks for them.
class Facets : public btPrimitiveManagerBase {
 public:
  explicit Facets(const WorkloadBody& body) : body_(body), mesh_(view_of(body, 0)) {}

  void set_frame(int frame) { mesh_ = view_of(body_, frame); }
  const MeshView& mesh() const { return mesh_; }

  bool is_trimesh() const override { return true; }
  int get_primitive_count() const override { return mesh_.facet_count; }
  void get_primitive_box(int facet, btAABB& box) const override {
    const FacetCorners t = mesh_.corners(facet);
    box.calc_from_triangle(vector(t[0]), vector(t[1]), vector(t[2]));
  }
  void get_primitive_triangle(int facet, btPrimitiveTriangle& triangle) const override {
    const FacetCorners t = mesh_.corners(facet);
    for (std::size_t k = 0; k < 3; ++k) triangle.m_vertices[k] = vector(t[k]);
    triangle.m_margin = 0;
  }

 private:
  static btVector3 vector(const base::Vec3& p) {
    return {static_cast<btScalar>(p.x), static_cast<btScalar>(p.y), static_cast<btScalar>(p.z)};
  }

  const WorkloadBody& body_;
  MeshView mesh_;
};

struct Body {
  explicit Body(const WorkloadBody& body) : facets(body), boxes(&facets) { boxes.buildSet(); }

  Facets facets;
  btGImpactBvh boxes;
  btBroadphaseProxy* proxy = nullptr;
};

class Bullet : public Rival {
 public:
  Bullet(const Workload& workload, int threads)
      : workload_(workload), threads_(useful_threads(workload, threads)), lists_(threads_) {
    for (const WorkloadBody& body : workload.bodies) {
      bodies_.push_back(std::make_unique<Body>(body));
      const btAABB box = bodies_.back()->boxes.getGlobalBox();
      void* number = reinterpret_cast<void*>(bodies_.size() - 1);
      bodies_.back()->proxy = broadphase_.createProxy(box.m_min, box.m_max, 0, number, 1, 1, nullptr);
    }
    for (int k = 0; k < threads_; ++k) candidates_.push_back(std::make_unique<btPairSet>());
  }

  ~Bullet() override {
    for (const auto& body : bodies_) broadphase_.destroyProxy(body->proxy, nullptr);
  }

  void step(int frame) override {
    base::parallel_for(bodies_.size(), 1, threads_, [&](std::size_t k) {
      if (workload_.bodies[k].fixed()) return;
      bodies_[k]->facets.set_frame(frame);
      bodies_[k]->boxes.update();
    });
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      if (workload_.bodies[k].fixed()) continue;
      const btAABB box = bodies_[k]->boxes.getGlobalBox();
      broadphase_.setAabb(bodies_[k]->proxy, box.m_min, box.m_max, nullptr);
    }
    broadphase_.calculateOverlappingPairs(nullptr);
    const btBroadphasePairArray& pairs = broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
    lists_.clear();
    base::parallel_for(static_cast<std::size_t>(pairs.size()), 1, threads_,
                       [&](std::size_t k, int thread) { collide(pairs[static_cast<int>(k)], thread); });
  }

  std::vector<FacetMeeting> meetings() const override { return lists_.sorted(); }

 private:
  void collide(const btBroadphasePair& pair, int thread) {
    const auto number = [](const btBroadphaseProxy* proxy) {
      return static_cast<int>(reinterpret_cast<std::size_t>(proxy->m_clientObject));
    };
    const auto [a, b] = std::minmax({number(pair.m_pProxy0), number(pair.m_pProxy1)});
    Body& first = *bodies_[a];
    Body& second = *bodies_[b];
    // The pair cache holds fattened boxes, and pairs that are separated by now.
    if (!first.boxes.getGlobalBox().has_collision(second.boxes.getGlobalBox())) return;
    btPairSet& candidates = *candidates_[thread];
    candidates.resizeNoInitialize(0);
    const btTransform still = btTransform::getIdentity();
    btGImpactBvh::find_collision(&first.boxes, still, &second.boxes, still, candidates);
    for (int k = 0; k < candidates.size(); ++k) {
      const int i = candidates[k].m_index1, j = candidates[k].m_index2;
      if (!facets_meet(first.facets.mesh(), i, second.facets.mesh(), j, TriangleTest::exact)) continue;
      lists_.of_thread(thread).push_back({a, b, i, j});
    }
  }

  const Workload& workload_;
  int threads_;
  btDbvtBroadphase broadphase_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<btPairSet>> candidates_;  // one a thread
  MeetingLists lists_;
};

}  // namespace

std::unique_ptr<Rival> make_bullet_gimpact(const Workload& workload, int threads) {
  return std::make_unique<Bullet>(workload, threads);
}

}  // namespace tact::bench
