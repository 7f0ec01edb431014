#include "narrowphase/self/vertex_fans.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tact::narrowphase {

namespace {

// With u = 2^-53, an edge is wrong by u in each coordinate, a normal by 6 u times the lengths of its edges, its product
// with w by 10 u times all three lengths. The direction of the first edge's line is w times that edge, and its product
// with another edge is wrong by 16 u times all three lengths: kSideRounding is twice that. Two edges that seem to be on
// that line may then be 180 degrees from each other but for 2^-47 times the lengths over those that are seen along w,
// which kLeastTurn bounds: its square has to be larger than that. Angles are narrower seldom.
constexpr double kSideRounding = 0x1p-48, kLeastTurn = 0x1p-20;
// Products of six such lengths neither vanish nor overflow.
constexpr double kLeastLength = 0x1p-150, kLargestLength = 0x1p150;

double sum_of_sizes(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

using Side = std::pair<int, int>;  // an end of an edge at the vertex, and the other one in its facet

// An end, and those of the facets that have it.
struct End {
  int vertex, beside[2], count;
};

// Puts the ends into the order in which facets follow each other, if these are one row. `sides` holds each facet twice,
// once from either end; `ends` is memory, used again.
void append_row(std::vector<Side>& sides, std::vector<End>& ends, std::vector<int>& row) {
  std::ranges::sort(sides);
  ends.clear();
  for (const auto& [vertex, beside] : sides) {
    if (ends.empty() || ends.back().vertex != vertex) {
      ends.push_back({vertex, {beside, -1}, 1});
    } else if (ends.back().count == 2) {
      return;
    } else {
      ends.back().beside[ends.back().count++] = beside;
    }
  }
  const auto border = std::ranges::find(ends, 1, &End::count);
  const bool is_closed = border == ends.end();
  const std::size_t facets = sides.size() / 2, start = row.size();
  if (is_closed && facets < 3) return;
  const int first = is_closed ? ends.front().vertex : border->vertex;
  row.push_back(first);
  for (int last = -1, at = first; row.size() <= start + facets;) {
    const End& end = *std::ranges::lower_bound(ends, at, {}, &End::vertex);
    const int next = end.beside[end.beside[0] == last ? 1 : 0];
    if (next < 0) break;
    row.push_back(next);
    if (next == first) break;
    last = std::exchange(at, next);
  }
  const bool is_whole = row.size() == start + facets + 1 && is_closed == (row.back() == first);
  if (!is_whole) row.resize(start);
}

}  // namespace

VertexFans::VertexFans(const ClusteredMesh& mesh) {
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<int> begin(vertices + 1, 0);
  std::vector<Corners> facets(static_cast<std::size_t>(mesh.facet_count()));
  for (int f = 0; f < mesh.facet_count(); ++f) {
    facets[f] = mesh.corners(f);
    for (const int v : facets[f]) ++begin[static_cast<std::size_t>(v) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<int> at(3 * facets.size()), next(begin.begin(), begin.end() - 1);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const int v : facets[f]) at[next[v]++] = static_cast<int>(f);
  }
  begin_.reserve(vertices + 1);
  begin_.push_back(0);
  around_.reserve(at.size() + vertices);
  std::vector<Side> sides;
  std::vector<End> ends;
  for (std::size_t v = 0; v < vertices; ++v) {
    const int vertex = static_cast<int>(v);
    sides.clear();
    bool is_plain = true;
    for (int i = begin[v]; i < begin[v + 1]; ++i) {
      const Corners& c = facets[at[i]];
      const std::size_t k = c[0] == vertex ? 0 : c[1] == vertex ? 1 : 2;
      const int p = c[(k + 1) % 3], q = c[(k + 2) % 3];
      is_plain = is_plain && p != q && p != vertex && q != vertex;
      sides.insert(sides.end(), {{p, q}, {q, p}});
    }
    if (is_plain && !sides.empty()) append_row(sides, ends, around_);
    begin_.push_back(static_cast<int>(around_.size()));
  }
}

bool VertexFans::lie_open(const ClusteredMesh& mesh, int vertex, std::vector<Vec3>& sides) const {
  const std::span<const int> row = around(vertex);
  if (row.empty()) return false;
  const Vec3 v = mesh.position(vertex);
  sides.clear();
  Vec3 w;
  for (const int end : row) {
    sides.push_back(mesh.position(end) - v);
    if (sides.size() > 1) w = w + cross(sides[sides.size() - 2], sides.back());
  }
  const double size = sum_of_sizes(w);
  const Vec3 across = cross(w, sides.front());
  const double size_across = kSideRounding * size * sum_of_sizes(sides.front());
  const std::size_t last = row.size() - (row.front() == row.back() ? 2 : 1);  // that is not the first again
  double length = sum_of_sizes(sides.front());
  bool was_right = false;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const double before = std::exchange(length, sum_of_sizes(sides[i]));
    if (!(before > kLeastLength && before < kLargestLength)) return false;
    const double turn = dot(w, cross(sides[i - 1], sides[i]));
    if (!(turn > kLeastTurn * size * before * length)) return false;
    const bool is_right = dot(across, sides[i]) < -size_across * length;
    if (i <= last && was_right && !is_right) return false;
    was_right = was_right || is_right;
  }
  return length > kLeastLength && length < kLargestLength;
}

}  // namespace tact::narrowphase
