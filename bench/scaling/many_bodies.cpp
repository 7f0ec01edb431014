#include "bench/scaling/many_bodies.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "bench/measure.h"
#include "bench/random.h"
#include "bench/rivals/nearest_in_triangle.h"
#include "bench/table.h"
#include "bench/workloads/shapes.h"

namespace tact::bench {
namespace {

constexpr double kDifference = 1e-12;  // of distances, metres
constexpr double kRadius = 0.3;        // of balls on a lattice, a metre from each other

// A ball at each place of a cubic lattice.
struct Lattice {
  explicit Lattice(int side) : ball(geodesic_sphere(2)) {
    ball.positions *= kRadius;
    for (int i = 0; i < side * side * side; ++i) middles.emplace_back(i % side, i / side % side, i / side / side);
  }

  Shape ball;
  std::vector<Eigen::Vector3d> middles;
};

double distance_from_ball(const Shape& ball, const Eigen::Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < ball.facets.cols(); ++f) {
    const auto corner = [&](int k) -> Eigen::Vector3d { return ball.positions.col(ball.facets(k, f)); };
    least = std::min(least, (nearest_in_triangle<double>(point, corner(0), corner(1), corner(2)) - point).norm());
  }
  return least;
}

// The rival: the boxes of all bodies, then the facets of those that are nearer than what was found, nearest first.
double distance_by_loop(const Lattice& lattice, const Eigen::Vector3d& point, std::vector<double>& distances) {
  distances.resize(lattice.middles.size());
  for (std::size_t i = 0; i < distances.size(); ++i)
    distances[i] = ((point - lattice.middles[i]).cwiseAbs().array() - kRadius).max(0.0).matrix().norm();
  double least = std::numeric_limits<double>::infinity();
  for (auto next = std::ranges::min_element(distances); *next < least; next = std::ranges::min_element(distances)) {
    const Eigen::Vector3d& middle = lattice.middles[static_cast<std::size_t>(next - distances.begin())];
    least = std::min(least, distance_from_ball(lattice.ball, point - middle));
    *next = std::numeric_limits<double>::infinity();
  }
  return least;
}

void add_row(int side, bool quick, Table& table) {
  const Lattice lattice(side);
  World world({.threads = 1});
  for (const Eigen::Vector3d& middle : lattice.middles) {
    const Eigen::Matrix3Xd positions = lattice.ball.positions.colwise() + middle;
    world.add_body({.positions = positions, .facets = lattice.ball.facets});
  }
  Random random(62);
  std::vector<PointQuery> points(quick ? 100 : 1000);
  const auto coordinate = [&] { return random.uniform(-0.5, side - 0.5); };
  for (PointQuery& query : points) query.point << coordinate(), coordinate(), coordinate();
  std::vector<double> scratch;
  for (const PointQuery& query : points) {
    const double own = world.closest_point(query).distance, by_loop = distance_by_loop(lattice, query.point, scratch);
    if (!(std::abs(own - by_loop) <= kDifference))
      throw std::runtime_error(fmt::format("a body is {} away, not {}", own, by_loop));
  }
  // Microseconds a query, of the fastest of a few rounds.
  const auto microseconds = [&](const auto& ask) {
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < (quick ? 1 : 5); ++round) {
      const double taken = time_ms(1, 2.0 * kShortWork_ms, [&] {
        for (const PointQuery& query : points) ask(query);
      });
      best = std::min(best, 1e3 * taken / static_cast<double>(points.size()));
    }
    return best;
  };
  const double own = microseconds([&](const PointQuery& query) { world.closest_point(query); });
  const double by_loop =
      microseconds([&](const PointQuery& query) { distance_by_loop(lattice, query.point, scratch); });
  table.add({fmt::to_string(lattice.middles.size()), fmt::to_string(lattice.ball.facets.cols()), three_digits(own),
             three_digits(by_loop), three_digits(by_loop / own)});
}

}  // namespace

void measure_many_bodies(const BenchOptions& options) {
  Table table({"nearest points, bodies", "facets each", "tact us", "loop us", "loop / tact"});
  for (const int side : options.quick ? std::vector{6} : std::vector{3, 5, 10, 22}) add_row(side, options.quick, table);
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "queries_of_many_bodies.csv");
}

}  // namespace tact::bench
