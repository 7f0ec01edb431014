#include "scenes/files/weld_frames.h"

#include <tact/weld.h>

#include <algorithm>
#include <map>
#include <utility>

namespace tact::scenes {
namespace {

// Splits the groups of vertices of the frames so far, by number, where another frame has the vertices apart. Groups are
// numbered as they first come up.
void split_groups(const Eigen::Matrix3Xd& positions, std::vector<int>& groups) {
  const std::vector<int> here = weld(positions, Eigen::Matrix3Xi(3, 0)).vertex_of;
  std::map<std::pair<int, int>, int> numbers;
  for (std::size_t v = 0; v < groups.size(); ++v) {
    const int next = static_cast<int>(numbers.size());
    groups[v] = numbers.try_emplace({groups[v], here[v]}, next).first->second;
  }
}

}  // namespace

void weld_frames(BodyFrames& body) {
  std::vector<int> groups(static_cast<std::size_t>(body.positions.front().cols()), 0);
  for (const Eigen::Matrix3Xd& positions : body.positions) split_groups(positions, groups);
  // The first vertex of each group stands for it.
  std::vector<int> first;
  for (std::size_t v = 0; v < groups.size(); ++v) {
    if (static_cast<std::size_t>(groups[v]) == first.size()) first.push_back(static_cast<int>(v));
  }
  body.weld.merged_vertices = static_cast<int>(groups.size() - first.size());
  for (Eigen::Matrix3Xd& positions : body.positions) positions = Eigen::Matrix3Xd(positions(Eigen::all, first));
  if (!body.vertices.empty())
    std::ranges::transform(first, first.begin(), [&](int v) { return body.vertices[static_cast<std::size_t>(v)]; });
  body.vertices = std::move(first);
  const auto is_flat = [](const Eigen::Vector3i& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; };
  for (auto facet : body.facets.colwise()) {
    const bool was_flat = is_flat(facet);
    for (int& corner : facet) corner = groups[static_cast<std::size_t>(corner)];
    body.weld.collapsed_facets += is_flat(facet) && !was_flat;
  }
}

}  // namespace tact::scenes
