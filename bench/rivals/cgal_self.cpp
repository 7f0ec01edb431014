// CGAL: Polygon_mesh_processing::self_intersections() on a Surface_mesh, made once, whose points are set in each step.
// It also reports neighbours that lie on each other, which are left out. One thread.
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <utility>

#include "bench/meeting_lists.h"
#include "bench/rivals/rival.h"

namespace tact::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

class CgalSelf : public Rival {
 public:
  explicit CgalSelf(const Workload& workload) : workload_(workload) {
    for (const WorkloadBody& body : workload.bodies) {
      const MeshView view = view_of(body, 0);
      SurfaceMesh& mesh = meshes_.emplace_back();
      for (int v = 0; v < view.vertex_count; ++v) mesh.add_vertex(Kernel::Point_3(0, 0, 0));
      using Vertex = SurfaceMesh::Vertex_index;
      const auto vertex = [&](Eigen::Index k, Eigen::Index f) {
        return Vertex(static_cast<SurfaceMesh::size_type>(body.facets(k, f)));
      };
      for (Eigen::Index f = 0; f < body.facets.cols(); ++f) mesh.add_face(vertex(0, f), vertex(1, f), vertex(2, f));
    }
  }

  void step(int frame) override {
    found_.clear();
    for (std::size_t k = 0; k < meshes_.size(); ++k) {
      const MeshView view = view_of(workload_.bodies[k], frame);
      for (const SurfaceMesh::Vertex_index v : meshes_[k].vertices()) {
        const base::Vec3 p = view.vertex(static_cast<int>(v));
        meshes_[k].point(v) = Kernel::Point_3(p.x, p.y, p.z);
      }
      pairs_.clear();
      CGAL::Polygon_mesh_processing::self_intersections(meshes_[k], std::back_inserter(pairs_));
      for (const auto& [f, g] : pairs_) {
        const auto [a, b] = std::minmax({static_cast<int>(f), static_cast<int>(g)});
        if (!share_a_vertex(view, a, b)) found_.push_back({static_cast<int>(k), static_cast<int>(k), a, b});
      }
    }
  }

  std::vector<FacetMeeting> meetings() const override {
    std::vector<FacetMeeting> all = found_;
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  const Workload& workload_;
  std::vector<SurfaceMesh> meshes_;
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs_;
  std::vector<FacetMeeting> found_;
};

}  // namespace

std::unique_ptr<Rival> make_cgal_self(const Workload& workload, int) { return std::make_unique<CgalSelf>(workload); }

}  // namespace tact::bench
