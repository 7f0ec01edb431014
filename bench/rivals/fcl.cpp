// FCL, as its maintainers advise for deforming meshes: a hierarchy a body, new vertices by beginReplaceModel() (not
// beginUpdateModel(), whose boxes hold the last frame too), refitted bottom up; bodies paired by its dynamic AABB tree.
// The traversal is called directly: fcl::collide() would copy both models for every pair.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <limits>
#include <type_traits>
#include <utility>

#include "bench/meeting_lists.h"
#include "bench/rivals/fcl_model.h"
#include "bench/rivals/rival.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

using AabbNode = fcl::detail::MeshCollisionTraversalNode<fcl::AABBd>;
using ObbrssNode = fcl::detail::MeshCollisionTraversalNodeOBBRSSd;

// A traversal that decides pairs of leaves by the rivals' exact test.
template <class Node>
class ExactNode : public Node {
 public:
  ExactNode(const MeshView& a, const MeshView& b, int body_a, int body_b, std::vector<FacetMeeting>& meetings)
      : a_(a), b_(b), body_a_(body_a), body_b_(body_b), meetings_(meetings) {}

  void leafTesting(int leaf_a, int leaf_b) const override {
    const int i = this->model1->getBV(leaf_a).primitiveId(), j = this->model2->getBV(leaf_b).primitiveId();
    if (facets_meet(a_, i, b_, j, TriangleTest::exact)) meetings_.push_back({body_a_, body_b_, i, j});
  }
  bool canStop() const override { return false; }

 private:
  MeshView a_, b_;
  int body_a_, body_b_;
  std::vector<FacetMeeting>& meetings_;
};

enum class LeafTest { exact, own };

template <class Volume, class Node, LeafTest kTest>
class Fcl : public Rival {
 public:
  Fcl(const Workload& workload, int threads)
      : workload_(workload), threads_(useful_threads(workload, threads)), lists_(threads_) {
    for (const WorkloadBody& body : workload.bodies) {
      models_.push_back(std::make_shared<Model>());
      build_fcl_model(*models_.back(), body);
      objects_.push_back(std::make_unique<fcl::CollisionObjectd>(models_.back()));
      objects_.back()->setUserData(reinterpret_cast<void*>(objects_.size() - 1));
      manager_.registerObject(objects_.back().get());
    }
    manager_.setup();
  }

  void step(int frame) override {
    base::parallel_for(models_.size(), 1, threads_, [&](std::size_t k) {
      if (!workload_.bodies[k].fixed()) refit(k, frame);
    });
    manager_.update();
    pairs_.clear();
    manager_.collide(&pairs_, collect);
    lists_.clear();
    base::parallel_for(pairs_.size(), 1, threads_,
                       [&](std::size_t k, int thread) { collide(pairs_[k], frame, lists_.of_thread(thread)); });
  }

  std::vector<FacetMeeting> meetings() const override { return lists_.sorted(); }

 private:
  using Model = fcl::BVHModel<Volume>;
  using BodyPair = std::pair<int, int>;

  void refit(std::size_t k, int frame) {
    Model& model = *models_[k];
    refit_fcl_model(model, workload_.bodies[k].positions(frame));
    if constexpr (std::is_same_v<Volume, fcl::AABBd>) {
      model.aabb_local = model.getBV(0).bv;  // what computeLocalAABB() would find anew
    } else {
      model.computeLocalAABB();
    }
    objects_[k]->computeAABB();
  }

  static bool collect(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* pairs) {
    const auto number = [](fcl::CollisionObjectd* object) {
      return static_cast<int>(reinterpret_cast<std::size_t>(object->getUserData()));
    };
    static_cast<std::vector<BodyPair>*>(pairs)->push_back(std::minmax(number(a), number(b)));
    return false;
  }

  void collide(BodyPair pair, int frame, std::vector<FacetMeeting>& meetings) {
    const auto [a, b] = pair;
    const std::size_t i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), false);
    fcl::CollisionResultd result;
    const auto run = [&](Node& node) {
      fcl::Transform3d still_a = fcl::Transform3d::Identity(), still_b = still_a;
      if constexpr (std::is_same_v<Volume, fcl::AABBd>) {
        fcl::detail::initialize(node, *models_[i], still_a, *models_[j], still_b, request, result);
      } else {
        fcl::detail::initialize(node, std::as_const(*models_[i]), std::as_const(still_a), std::as_const(*models_[j]),
                                std::as_const(still_b), request, result);
      }
      fcl::detail::collide<double>(&node);
    };
    if constexpr (kTest == LeafTest::exact) {
      ExactNode<Node> node(view_of(workload_.bodies[i], frame), view_of(workload_.bodies[j], frame), a, b, meetings);
      run(node);
    } else {
      Node node;
      run(node);
      for (std::size_t k = 0; k < result.numContacts(); ++k) {
        const fcl::Contactd& contact = result.getContact(k);
        meetings.push_back({a, b, static_cast<int>(contact.b1), static_cast<int>(contact.b2)});
      }
    }
  }

  const Workload& workload_;
  int threads_;
  std::vector<std::shared_ptr<Model>> models_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  std::vector<BodyPair> pairs_;
  MeetingLists lists_;
};

}  // namespace

std::unique_ptr<Rival> make_fcl_aabb(const Workload& workload, int threads) {
  return std::make_unique<Fcl<fcl::AABBd, AabbNode, LeafTest::exact>>(workload, threads);
}

std::unique_ptr<Rival> make_fcl_obbrss(const Workload& workload, int threads) {
  return std::make_unique<Fcl<fcl::OBBRSSd, ObbrssNode, LeafTest::exact>>(workload, threads);
}

std::unique_ptr<Rival> make_fcl_own_test(const Workload& workload, int threads) {
  return std::make_unique<Fcl<fcl::AABBd, AabbNode, LeafTest::own>>(workload, threads);
}

}  // namespace tact::bench
