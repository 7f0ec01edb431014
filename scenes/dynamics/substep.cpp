#include "scenes/dynamics/substep.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kVerticesAtATime = 2048;  // vertices

double longest_way(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double square = 0.0;
  for (std::size_t v = 0; v < from.size(); ++v) square = std::max(square, norm_squared(to[v] - from[v]));
  return std::sqrt(square);
}

}  // namespace

void begin_substep(Body& body, std::vector<Vec3>& before, const Substep& substep) {
  const double h = substep.seconds;
  const Vec3 fall{0.0, 0.0, -substep.gravity * body.weight * h};
  const double keep = 1.0 / (1.0 + body.drag * h);
  if (body.rigid) {
    body.rigid->begin_substep(h, fall, keep);
    return;
  }
  base::parallel_for(body.positions.size(), kVerticesAtATime, substep.threads, [&](std::size_t v) {
    before[v] = body.positions[v];
    if (!(body.inverse_masses[v] > 0.0)) return;
    body.positions[v] = body.positions[v] + (h * keep) * (body.velocities[v] + fall);
  });
  body.springs.solve(body.positions, body.inverse_masses, h, substep.threads);
  if (body.volume) body.volume->solve(body.positions, body.facets, body.inverse_masses, h);
  if (body.shape) body.shape->solve(body.positions, body.inverse_masses, h);
}

void shorten_ways(Body& body, const std::vector<Vec3>& before, double most) {
  if (!body.dynamic) return;
  if (body.rigid) {
    body.rigid->shorten(most);
    return;
  }
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Vec3 way = body.positions[v] - before[v];
    const double square = norm_squared(way);
    if (square > most * most && body.inverse_masses[v] > 0.0)
      body.positions[v] = before[v] + (most / std::sqrt(square)) * way;
  }
}

double end_substep(Body& body, const std::vector<Vec3>& before, const Substep& substep) {
  const double h = substep.seconds;
  if (body.rigid) {
    const double way = body.rigid->way();
    body.rigid->end_substep(h);
    return way;
  }
  const double way = longest_way(before, body.positions);
  base::parallel_for(body.positions.size(), kVerticesAtATime, substep.threads,
                     [&](std::size_t v) { body.velocities[v] = (1.0 / h) * (body.positions[v] - before[v]); });
  return way;
}

}  // namespace tact::scenes
