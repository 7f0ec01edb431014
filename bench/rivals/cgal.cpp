// CGAL: box_intersection_d over the facets' boxes of each pair of bodies whose boxes overlap, as its manual shows, with
// pointers to boxes (cheaper to sort than the boxes). Nothing is kept from frame to frame. *Clipped*: only facets that
// may reach into the box that both bodies share are given to it; the vertices' sides of that box tell which.
#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>

#include <type_traits>
#include <utility>

#include "bench/meeting_lists.h"
#include "bench/rivals/cgal_box.h"
#include "bench/rivals/rival.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

struct CgalBoxes {
  std::vector<CgalBox> boxes;
  std::vector<const CgalBox*> pointers;

  void finish() {
    pointers.clear();
    for (const CgalBox& box : boxes) pointers.push_back(&box);
  }
};

base::Box body_box(const MeshView& mesh) {
  base::Box box;
  for (int v = 0; v < mesh.vertex_count; ++v) box = base::extended(box, mesh.vertex(v));
  return box;
}

// A bit for each of the six sides of `box` that `p` is strictly outside of.
unsigned char sides_outside(const base::Box& box, const base::Vec3& p) {
  return static_cast<unsigned char>((p.x < box.lower.x) | (p.x > box.upper.x) << 1 | (p.y < box.lower.y) << 2 |
                                    (p.y > box.upper.y) << 3 | (p.z < box.lower.z) << 4 | (p.z > box.upper.z) << 5);
}

enum class Clipping { off, on };

// What a thread needs for a pair of bodies.
struct Scratch {
  CgalBoxes a, b;
  std::vector<unsigned char> outside_a, outside_b;
};

class Cgal : public Rival {
 public:
  Cgal(const Workload& workload, int threads, Clipping clipping, TriangleTest test)
      : workload_(workload),
        threads_(useful_threads(workload, threads)),
        clipping_(clipping),
        test_(test),
        body_boxes_(workload.bodies.size()),
        lists_(threads_),
        scratch_(static_cast<std::size_t>(threads_)) {
    for (std::size_t k = 0; k < body_boxes_.size(); ++k) body_boxes_[k] = body_box(view_of(workload.bodies[k], 0));
  }

  void step(int frame) override {
    base::parallel_for(body_boxes_.size(), 1, threads_, [&](std::size_t k) {
      if (!workload_.bodies[k].fixed()) body_boxes_[k] = body_box(view_of(workload_.bodies[k], frame));
    });
    find_body_pairs();
    lists_.clear();
    found_.clear();
    if (pairs_.size() < static_cast<std::size_t>(threads_)) {  // too few to share out: CGAL divides each
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
      for (const auto& [a, b] : pairs_) collide<CGAL::Parallel_tag>(a, b, frame, 0);
    } else {
      base::parallel_for(pairs_.size(), 1, threads_, [&](std::size_t k, int thread) {
        collide<CGAL::Sequential_tag>(pairs_[k].first, pairs_[k].second, frame, thread);
      });
    }
  }

  std::vector<FacetMeeting> meetings() const override {
    std::vector<FacetMeeting> all = lists_.sorted();
    for (const std::vector<FacetMeeting>& some : found_) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  void find_body_pairs() {
    Scratch& scratch = scratch_[0];
    scratch.a.boxes.clear();
    for (std::size_t k = 0; k < body_boxes_.size(); ++k) scratch.a.boxes.push_back({body_boxes_[k], k});
    scratch.a.finish();
    pairs_.clear();
    CGAL::box_self_intersection_d(
        scratch.a.pointers.begin(), scratch.a.pointers.end(), [&](const CgalBox* a, const CgalBox* b) {
          pairs_.push_back(std::minmax(static_cast<int>(a->number), static_cast<int>(b->number)));
        });
  }

  void gather(const MeshView& mesh, const base::Box& common, std::size_t first_number, CgalBoxes& boxes,
              std::vector<unsigned char>& outside) const {
    boxes.boxes.clear();
    if (clipping_ == Clipping::on) {
      outside.resize(mesh.vertex_count);
      for (int v = 0; v < mesh.vertex_count; ++v) {
        outside[v] = sides_outside(common, mesh.vertex(v));
      }
    }
    for (int f = 0; f < mesh.facet_count; ++f) {
      if (clipping_ == Clipping::on) {
        const int* corner = mesh.facets + 3 * static_cast<std::ptrdiff_t>(f);
        const auto side = [&](int k) { return outside[corner[k]]; };
        if ((side(0) & side(1) & side(2)) != 0) continue;
      }
      boxes.boxes.push_back({box_of(mesh.corners(f)), first_number + static_cast<std::size_t>(f)});
    }
    boxes.finish();
  }

  template <class Concurrency>
  void collide(int body_a, int body_b, int frame, int thread) {
    const MeshView a = view_of(workload_.bodies[body_a], frame);
    const MeshView b = view_of(workload_.bodies[body_b], frame);
    const base::Box common = base::intersection(body_boxes_[body_a], body_boxes_[body_b]);
    Scratch& scratch = scratch_[thread];
    const std::size_t first_of_b = static_cast<std::size_t>(a.facet_count);
    constexpr bool kParallel = std::is_same_v<Concurrency, CGAL::Parallel_tag>;
    base::parallel_for(2, 1, kParallel ? threads_ : 1, [&](std::size_t which) {
      which == 0 ? gather(a, common, 0, scratch.a, scratch.outside_a)
                 : gather(b, common, first_of_b, scratch.b, scratch.outside_b);
    });
    const auto report = [&](const CgalBox* p, const CgalBox* q) {
      const int i = static_cast<int>(p->number), j = static_cast<int>(q->number - first_of_b);
      if (!facets_meet(a, i, b, j, test_)) return;
      auto& list = kParallel ? found_.local() : lists_.of_thread(thread);
      list.push_back({body_a, body_b, i, j});
    };
    CGAL::box_intersection_d<Concurrency>(scratch.a.pointers.begin(), scratch.a.pointers.end(),
                                          scratch.b.pointers.begin(), scratch.b.pointers.end(), report);
  }

  const Workload& workload_;
  int threads_;
  Clipping clipping_;
  TriangleTest test_;
  std::vector<base::Box> body_boxes_;
  std::vector<std::pair<int, int>> pairs_;
  MeetingLists lists_;
  std::vector<Scratch> scratch_;  // one a thread
  tbb::enumerable_thread_specific<std::vector<FacetMeeting>> found_;
};

}  // namespace

std::unique_ptr<Rival> make_cgal_boxes(const Workload& workload, int threads) {
  return std::make_unique<Cgal>(workload, threads, Clipping::off, TriangleTest::exact);
}

std::unique_ptr<Rival> make_cgal_clipped(const Workload& workload, int threads) {
  return std::make_unique<Cgal>(workload, threads, Clipping::on, TriangleTest::exact);
}

std::unique_ptr<Rival> make_cgal_clipped_plain(const Workload& workload, int threads) {
  return std::make_unique<Cgal>(workload, threads, Clipping::on, TriangleTest::plain);
}

}  // namespace tact::bench
