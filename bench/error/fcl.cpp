#include <fcl/fcl.h>
#include <fmt/format.h>

#include <cmath>
#include <exception>

#include "bench/error/methods.h"

namespace tact::bench {
namespace {

std::shared_ptr<fcl::Convexd> convex(const Mesh& mesh) {
  const auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto p : mesh.positions.colwise()) vertices->push_back(p);
  const auto faces = std::make_shared<std::vector<int>>();
  for (const auto f : mesh.facets.colwise()) faces->insert(faces->end(), {3, f[0], f[1], f[2]});
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.facets.cols()), faces);
}

class FclHulls : public HullMethod {
 public:
  FclHulls(const HullRow& row, fcl::GJKSolverType solver, double tolerance)
      : row_(row), results_(row.pairs.size()), failed_(row.pairs.size()) {
    for (const HullPair& pair : row.pairs) {
      a_.emplace_back(convex(pair.a));
      b_.emplace_back(convex(pair.b));
    }
    request_.enable_contact = true;
    request_.gjk_solver_type = solver;
    request_.gjk_tolerance = tolerance;
  }

  void step(int frame) override {
    for (std::size_t i = 0; i < a_.size(); ++i) {
      b_[i].setTranslation(row_.pairs[i].path[frame]);
      results_[i].clear();
      failed_[i] = false;
      try {
        fcl::collide(&a_[i], &b_[i], request_, results_[i]);
      } catch (const std::exception&) {  // of its polytope, when its own assumptions fail
        failed_[i] = true;
      }
    }
  }

  HullAnswer answer(std::size_t pair) const override {
    const fcl::CollisionResultd& result = results_[pair];
    if (failed_[pair]) return {.failed = true};
    if (!result.isCollision()) return {};
    const fcl::Contactd& contact = result.getContact(0);
    const bool finite = std::isfinite(contact.penetration_depth) && contact.normal.allFinite();
    // Its own solver gives the depth a minus.
    return {true, std::abs(contact.penetration_depth), contact.normal, !finite};
  }

 private:
  const HullRow& row_;
  std::vector<fcl::CollisionObjectd> a_, b_;
  fcl::CollisionRequestd request_;
  std::vector<fcl::CollisionResultd> results_;
  std::vector<char> failed_;
};

}  // namespace

std::vector<HullMethodKind> fcl_hull_methods() {
  std::vector<HullMethodKind> kinds;
  for (const fcl::GJKSolverType solver : {fcl::GST_LIBCCD, fcl::GST_INDEP}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
      kinds.push_back(
          {"FCL", fmt::format("{}, {:.0e}", solver == fcl::GST_LIBCCD ? "libccd" : "own", tolerance), Minimum::smallest,
           [solver, tolerance](const HullRow& row) { return std::make_unique<FclHulls>(row, solver, tolerance); }});
    }
  }
  return kinds;
}

}  // namespace tact::bench
