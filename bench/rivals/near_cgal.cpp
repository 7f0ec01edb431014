// Contact points from facets' boxes that CGAL finds to overlap.
#include <CGAL/box_intersection_d.h>

#include "bench/rivals/cgal_box.h"
#include "bench/rivals/near_bodies.h"

namespace tact::bench {
namespace {

// Only facets that reach into the box that both bodies share are given to it.
class CgalNear : public NearBase {
 public:
  using NearBase::NearBase;

 private:
  void moved(std::size_t) override {}
  void gather(const NearBody& body, const Box& common, std::size_t first, std::vector<CgalBox>& facets,
              std::vector<const CgalBox*>& pointers) {
    facets.clear();
    pointers.clear();
    for (std::size_t f = 0; f < body.boxes.size(); ++f) {
      if (base::overlaps(body.boxes[f], common)) facets.push_back({body.boxes[f], first + f});
    }
    for (const CgalBox& facet : facets) pointers.push_back(&facet);
  }
  void propose(std::size_t a, std::size_t b, FacetPoints& points) override {
    const Box common = base::intersection(bodies_[a]->all, bodies_[b]->all);
    const std::size_t first_of_b = bodies_[a]->boxes.size();
    gather(*bodies_[a], common, 0, facets_a_, pointers_a_);
    gather(*bodies_[b], common, first_of_b, facets_b_, pointers_b_);
    CGAL::box_intersection_d(pointers_a_.begin(), pointers_a_.end(), pointers_b_.begin(), pointers_b_.end(),
                             [&](const CgalBox* p, const CgalBox* q) {
                               const auto i = static_cast<int>(p->number), k = static_cast<int>(q->number - first_of_b);
                               if (a != b || i <= k) points.find(i, k);
                             });
  }

  std::vector<CgalBox> facets_a_, facets_b_;
  std::vector<const CgalBox*> pointers_a_, pointers_b_;
};

}  // namespace

std::unique_ptr<NearRival> make_near_cgal(const Workload& workload, const std::vector<double>& margins) {
  return std::make_unique<CgalNear>(workload, margins);
}

}  // namespace tact::bench
