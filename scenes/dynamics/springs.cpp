#include "scenes/dynamics/springs.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

#include "engine/base/parallel.h"

namespace tact::scenes {
namespace {

// Gives each spring the lowest group that none of its vertices has. A vertex of more than 63 springs sends the rest of
// them to groups of their own.
std::vector<int> find_groups(std::span<const Spring> springs, int vertex_count) {
  std::vector<std::uint64_t> taken(static_cast<std::size_t>(vertex_count), 0);
  std::vector<int> groups;
  groups.reserve(springs.size());
  int lonely = 64;
  for (const Spring& spring : springs) {
    std::uint64_t& a = taken[spring.a];
    std::uint64_t& b = taken[spring.b];
    const int group = std::countr_one(a | b);
    if (group < 64) a |= std::uint64_t{1} << group, b |= std::uint64_t{1} << group;
    groups.push_back(group < 64 ? group : lonely++);
  }
  return groups;
}

void solve_spring(const Spring& spring, std::vector<Vec3>& positions, const std::vector<double>& inverse_masses,
                  double inverse_h_squared) {
  Vec3& a = positions[spring.a];
  Vec3& b = positions[spring.b];
  const double mass_a = inverse_masses[spring.a];
  const double mass_b = inverse_masses[spring.b];
  const Vec3 along = b - a;
  const double length = norm(along);
  const double give = mass_a + mass_b + spring.compliance * inverse_h_squared;
  if (!(length > 0.0) || !(give > 0.0)) return;
  const Vec3 pull = ((length - spring.length) / (give * length)) * along;
  a = a + mass_a * pull;
  b = b - mass_b * pull;
}

}  // namespace

Springs::Springs(std::span<const Spring> springs, int vertex_count) {
  const std::vector<int> group = find_groups(springs, vertex_count);
  std::vector<std::size_t> order(springs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return group[i] < group[j]; });
  springs_.reserve(springs.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    springs_.push_back(springs[order[i]]);
    if (i + 1 == order.size() || group[order[i + 1]] != group[order[i]]) group_ends_.push_back(i + 1);
  }
}

void Springs::solve(std::vector<Vec3>& positions, const std::vector<double>& inverse_masses, double h,
                    int threads) const {
  constexpr std::size_t kGrain = 1024;
  const double inverse_h_squared = 1.0 / (h * h);
  std::size_t begin = 0;
  for (const std::size_t end : group_ends_) {
    base::parallel_for(end - begin, kGrain, threads, [&](std::size_t i) {
      solve_spring(springs_[begin + i], positions, inverse_masses, inverse_h_squared);
    });
    begin = end;
  }
}

}  // namespace tact::scenes
