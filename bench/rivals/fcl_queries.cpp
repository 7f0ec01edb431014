// FCL asked for nearest points: the distance of a mesh from a sphere that is hardly more than a point, by its traversal
// of a hierarchy of boxes, refitted bottom up as in fcl.cpp. It has no rays.
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_shape_distance_traversal_node.h>

#include "bench/rivals/fcl_model.h"
#include "bench/rivals/query_rival.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

constexpr double kPointRadius = 1e-12;  // metres: below what answers are compared to

class FclQueries : public QueryRival {
 public:
  FclQueries(const WorkloadBody& body, int threads) : threads_(threads) { build_fcl_model(model_, body); }

  void refit(const Eigen::Matrix3Xd& positions) override { refit_fcl_model(model_, positions); }

  bool ask(std::span<const Ray>) override { return false; }

  void ask(std::span<const PointQuery> points) override {
    answers_.resize(points.size());
    const fcl::Sphered sphere(kPointRadius);
    const Solver solver;
    base::parallel_for(points.size(), 16, threads_, [&](std::size_t i) {
      fcl::DistanceResultd result;
      Node node;
      fill(node, sphere, points[i].point, solver, result);
      fcl::detail::distance<double>(&node);
      answers_[i] = {static_cast<int>(result.b1), result.min_distance + kPointRadius};
    });
  }

  const std::vector<QueryAnswer>& answers() const override { return answers_; }

 private:
  using Solver = fcl::detail::GJKSolver_libccdd;
  using Node = fcl::detail::MeshShapeDistanceTraversalNode<fcl::AABBd, fcl::Sphered, Solver>;

  // What fcl::detail::initialize() does, which the library lacks for these types.
  void fill(Node& node, const fcl::Sphered& sphere, const fcl::Vector3d& at, const Solver& solver,
            fcl::DistanceResultd& result) const {
    node.result = &result;
    node.model1 = &model_;
    node.tf1.setIdentity();
    node.model2 = &sphere;
    node.tf2.setIdentity();
    node.tf2.translation() = at;
    node.nsolver = &solver;
    node.vertices = model_.vertices;
    node.tri_indices = model_.tri_indices;
    fcl::computeBV(sphere, node.tf2, node.model2_bv);
  }

  int threads_;
  fcl::BVHModel<fcl::AABBd> model_;
  std::vector<QueryAnswer> answers_;
};

}  // namespace

std::unique_ptr<QueryRival> make_fcl_queries(const WorkloadBody& body, int threads) {
  return std::make_unique<FclQueries>(body, threads);
}

}  // namespace tact::bench
