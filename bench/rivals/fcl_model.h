// A mesh as FCL's hierarchy of boxes, and how it follows a surface that moves.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <vector>

#include "bench/workloads/workloads.h"

namespace tact::bench {

// At the body's first frame.
template <class Volume>
void build_fcl_model(fcl::BVHModel<Volume>& model, const WorkloadBody& body) {
  std::vector<fcl::Vector3d> vertices;
  for (const auto& p : body.positions(0).colwise()) vertices.push_back(p);
  std::vector<fcl::Triangle> triangles;
  for (const auto& f : body.facets.colwise()) {
    triangles.emplace_back(static_cast<std::size_t>(f[0]), static_cast<std::size_t>(f[1]),
                           static_cast<std::size_t>(f[2]));
  }
  model.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model.addSubModel(vertices, triangles);
  model.endModel();
}

// Refitted bottom up.
template <class Volume>
void refit_fcl_model(fcl::BVHModel<Volume>& model, const Eigen::Matrix3Xd& positions) {
  model.beginReplaceModel();
  for (const auto& p : positions.colwise()) model.replaceVertex(p);
  model.endReplaceModel(true, true);
}

}  // namespace tact::bench
