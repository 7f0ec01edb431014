#include "bench/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure.h"
#include "bench/stability/shapes.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"
#include "engine/base/box.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::bench {
namespace {

using narrowphase::Triangle;
using narrowphase::Vec3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FclIntersect = fcl::detail::Intersect<double>;

struct TestPair {
  Triangle a, b;
};

struct PairSet {
  std::string name;
  std::vector<TestPair> pairs;  // facets with an area
};

// The pairs in the forms in which the libraries want them.
struct CgalPair {
  Kernel::Triangle_3 a, b;
};
using FclTriangle = std::array<fcl::Vector3d, 3>;

CgalPair to_cgal(const TestPair& pair) {
  const auto triangle = [](const Triangle& t) {
    const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
    return Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
  };
  return {triangle(pair.a), triangle(pair.b)};
}

FclTriangle to_fcl(const Triangle& t) {
  return {fcl::Vector3d(t[0].x, t[0].y, t[0].z), fcl::Vector3d(t[1].x, t[1].y, t[1].z),
          fcl::Vector3d(t[2].x, t[2].y, t[2].z)};
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (const auto f : mesh.facets.colwise()) {
    const auto corner = [&](int k) {
      const auto p = mesh.positions.col(f[k]);
      return Vec3{p.x(), p.y(), p.z()};
    };
    triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return triangles;
}

base::Box box_of(const Triangle& t) { return base::extended(base::extended(base::Box{t[0], t[0]}, t[1]), t[2]); }

// What a triangle test is asked about: the pairs of facets whose boxes overlap.
void add_box_pairs(const Mesh& a, const Mesh& b, std::vector<TestPair>& pairs) {
  const std::vector<Triangle> of_a = triangles_of(a), of_b = triangles_of(b);
  for (const Triangle& s : of_a) {
    for (const Triangle& t : of_b) {
      const CgalPair pair = to_cgal({s, t});
      if (base::overlaps(box_of(s), box_of(t)) && !pair.a.is_degenerate() && !pair.b.is_degenerate())
        pairs.push_back({s, t});
    }
  }
}

PairSet frames_of(std::string name, const Workload& workload) {
  PairSet set{std::move(name), {}};
  for (int frame = 0; frame < workload.frames; ++frame) {
    const auto mesh = [&](std::size_t body) {
      return Mesh{workload.bodies[body].positions(frame), workload.bodies[body].facets};
    };
    add_box_pairs(mesh(0), mesh(1), set.pairs);
  }
  return set;
}

template <class Make>
PairSet repeated(std::string name, int times, const Make& make) {
  PairSet set{std::move(name), {}};
  StabilityRandom random(1);
  for (int i = 0; i < times; ++i) make(random, set.pairs);
  return set;
}

std::vector<PairSet> pair_sets(bool quick) {
  const int times = quick ? 2 : 20;
  return {
      repeated("spheres", times,
               [](StabilityRandom& r, std::vector<TestPair>& pairs) {
                 add_box_pairs(ball_shape(3), moved(ball_shape(3), r.uniform(1.6, 1.9) * r.direction()), pairs);
               }),
      frames_of("organ and tool", organ_and_tool(times)),
      frames_of("cloth on sphere", cloth(16, times)),
      repeated("soups", times,
               [](StabilityRandom& r, std::vector<TestPair>& pairs) {
                 add_box_pairs(soup_shape(100, r), soup_shape(100, r), pairs);
               }),
      repeated("boxes face to face", 10 * times,
               [](StabilityRandom& r, std::vector<TestPair>& pairs) {
                 const double x = 0.25 * r.below(4), y = 0.25 * r.below(4);
                 add_box_pairs(box_shape({0, 0, 0}, {1, 1, 1}), box_shape({x, y, 1}, {x + 1, y + 1, 2}), pairs);
               }),
      repeated("boxes face to face, turned", 10 * times,
               [](StabilityRandom& r, std::vector<TestPair>& pairs) {
                 const double x = 0.25 * r.below(4), y = 0.25 * r.below(4);
                 const Eigen::Matrix3d turn = r.rotation();
                 add_box_pairs(rotated(box_shape({0, 0, 0}, {1, 1, 1}), turn),
                               rotated(box_shape({x, y, 1}, {x + 1, y + 1, 2}), turn), pairs);
               }),
      repeated("sheets in one plane", times,
               [](StabilityRandom& r, std::vector<TestPair>& pairs) {
                 add_box_pairs(sheet_shape(8), moved(sheet_shape(7), {r.uniform(0.0, 0.5), r.uniform(0.0, 0.5), 0.0}),
                               pairs);
               }),
      repeated("slivers to aspect 1e9", times,
               [](StabilityRandom& r, std::vector<TestPair>& pairs) {
                 add_box_pairs(sliver_shape(40, 1e9, r), sliver_shape(40, 1e9, r), pairs);
               }),
  };
}

// Nanoseconds a pair: the median over passes through the whole set for about `seconds`. Every pass must find `meeting`
// pairs that meet. Errors: std::runtime_error if one does not.
template <class Test>
double nanoseconds(std::size_t pairs, std::size_t meeting, double seconds, const Test& test) {
  std::vector<double> times;
  for (double spent = 0.0; times.size() < 5 || spent < 1e3 * seconds;) {
    const double start = wall_ms();
    std::size_t found = 0;
    for (std::size_t i = 0; i < pairs; ++i) found += test(i) ? 1 : 0;
    times.push_back(wall_ms() - start);
    if (found != meeting) throw std::runtime_error("a triangle test changed its answers");
    spent += times.back();
  }
  return 1e6 * median(times) / static_cast<double>(pairs);
}

// Adds the set's row; returns how many of tact's answers are not CGAL's.
int run_set(const PairSet& set, double seconds, Table& table) {
  std::vector<CgalPair> cgal;
  std::vector<std::pair<FclTriangle, FclTriangle>> fcl;
  for (const TestPair& pair : set.pairs) {
    cgal.push_back(to_cgal(pair));
    fcl.emplace_back(to_fcl(pair.a), to_fcl(pair.b));
  }
  const auto by_tact = [&](std::size_t i, narrowphase::PredicateCounts& counts) {
    return narrowphase::triangle_triangle_meet(set.pairs[i].a, set.pairs[i].b, counts);
  };
  const auto by_cgal = [&](std::size_t i) { return CGAL::do_intersect(cgal[i].a, cgal[i].b); };
  const auto by_fcl = [&](std::size_t i) {
    const auto& [a, b] = fcl[i];
    return FclIntersect::intersect_Triangle(a[0], a[1], a[2], b[0], b[1], b[2]);
  };
  std::size_t meeting = 0, tact_meeting = 0, fcl_meeting = 0, exact_pairs = 0, exact_predicates = 0;
  int wrong = 0, fcl_wrong = 0;
  for (std::size_t i = 0; i < set.pairs.size(); ++i) {
    narrowphase::PredicateCounts counts;
    const bool meet = by_cgal(i);
    const bool tact_meet = by_tact(i, counts), fcl_meet = by_fcl(i);
    wrong += tact_meet != meet;
    fcl_wrong += fcl_meet != meet;
    meeting += meet;
    tact_meeting += tact_meet;
    fcl_meeting += fcl_meet;
    exact_pairs += counts.exact > 0;
    exact_predicates += static_cast<std::size_t>(counts.exact);
  }
  const double count = static_cast<double>(set.pairs.size());
  narrowphase::PredicateCounts counts;
  const double tact_ns =
      nanoseconds(set.pairs.size(), tact_meeting, seconds, [&](std::size_t i) { return by_tact(i, counts); });
  const double cgal_ns = nanoseconds(set.pairs.size(), meeting, seconds, by_cgal);
  const double fcl_ns = nanoseconds(set.pairs.size(), fcl_meeting, seconds, by_fcl);
  table.add({set.name, fmt::format("{}", set.pairs.size()),
             fmt::format("{:.1f}", 100.0 * static_cast<double>(meeting) / count),
             fmt::format("{:.2f}", 100.0 * static_cast<double>(exact_pairs) / count),
             fmt::format("{:.3f}", static_cast<double>(exact_predicates) / count), three_digits(tact_ns),
             three_digits(cgal_ns), three_digits(fcl_ns), fmt::format("{}", wrong), fmt::format("{}", fcl_wrong)});
  return wrong;
}

}  // namespace

int run_predicates(const BenchOptions& options) {
  fmt::print("{}\n\nPairs of facets whose boxes overlap; nanoseconds a pair, median of many passes.\n\n",
             machine_line(1));
  Table table({"pairs of", "pairs", "meet %", "exact path in %", "exact predicates a pair", "tact ns", "CGAL ns",
               "FCL ns", "tact wrong", "FCL wrong"});
  int wrong = 0;
  for (const PairSet& set : pair_sets(options.quick)) wrong += run_set(set, options.quick ? 0.01 : 0.5, table);
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "predicates.csv");
  return wrong > 0 ? 1 : 0;
}

}  // namespace tact::bench
