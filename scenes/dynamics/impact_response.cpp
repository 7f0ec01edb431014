#include "scenes/dynamics/impact_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace tact::scenes {
namespace {

// Rounds of stopping before the last resort: the cheap one comes soon.
constexpr int kMostRounds = 20, kFewRounds = 5;
// How far bodies go of what is free where impacts are left: a hundredth of a gap stays open at each step.
constexpr double kPart = 0.99;

// One of the two features of an impact: up to three vertices of a body.
struct ImpactSide {
  Body& body;
  const std::vector<Vec3>& begin;
  std::array<std::size_t, 3> vertex;
  std::size_t count;
  std::array<double, 3> weight;

  Vec3 vertex_at(std::size_t k, double time) const {
    const Vec3 from = begin[vertex[k]];
    return from + time * (body.positions[vertex[k]] - from);
  }
  Vec3 at(double time) const {
    Vec3 sum;
    for (std::size_t k = 0; k < count; ++k) sum = sum + weight[k] * vertex_at(k, time);
    return sum;
  }
  // How much the point moves if a unit of momentum is shared by its vertices.
  double give() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += weight[k] * weight[k] * body.inverse_masses[vertex[k]];
    return sum;
  }
  void move(Vec3 momentum) {
    for (std::size_t k = 0; k < count; ++k)
      body.positions[vertex[k]] = body.positions[vertex[k]] + weight[k] * body.inverse_masses[vertex[k]] * momentum;
  }
};

ImpactSide side_of(Body& body, const std::vector<Vec3>& begin, const std::array<int, 3>& vertices) {
  ImpactSide side{body, begin, {}, 0, {}};
  for (const int v : vertices) {
    if (v >= 0) side.vertex[side.count++] = static_cast<std::size_t>(v);
  }
  side.weight.fill(1.0 / static_cast<double>(side.count));
  return side;
}

// The weights of the corners for the place of the triangle below `p`, cut off at its border.
std::array<double, 3> weights_below(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 e = b - a, f = c - a, d = p - a;
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), determinant = ee * ff - ef * ef;
  if (!(determinant > 0.0)) return {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  std::array<double, 3> w{0.0, (ff * dot(e, d) - ef * dot(f, d)) / determinant,
                          (ee * dot(f, d) - ef * dot(e, d)) / determinant};
  w[0] = 1.0 - w[1] - w[2];
  double sum = 0.0;
  for (double& weight : w) sum += weight = std::max(weight, 0.0);
  for (double& weight : w) weight /= sum;
  return w;
}

// Sets the weights to the places of both that are nearest to each other at a time.
void weigh(ImpactSide& a, ImpactSide& b, double time) {
  if (a.count == 1 && b.count == 1) return;
  if (a.count == 3 || b.count == 3) {
    ImpactSide &facet = a.count == 3 ? a : b, &vertex = a.count == 3 ? b : a;
    facet.weight =
        weights_below(vertex.at(time), facet.vertex_at(0, time), facet.vertex_at(1, time), facet.vertex_at(2, time));
    return;
  }
  const Vec3 p = a.vertex_at(0, time), e = a.vertex_at(a.count - 1, time) - p, q = b.vertex_at(0, time),
             f = b.vertex_at(b.count - 1, time) - q, d = q - p;
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), determinant = ee * ff - ef * ef;
  double s = determinant > 0.0 ? std::clamp((ff * dot(e, d) - ef * dot(f, d)) / determinant, 0.0, 1.0) : 0.5;
  const double t = ff > 0.0 ? std::clamp((s * ef - dot(f, d)) / ff, 0.0, 1.0) : 0.5;
  if (ee > 0.0) s = std::clamp((t * ef + dot(e, d)) / ee, 0.0, 1.0);
  a.weight = a.count == 1 ? std::array{1.0, 0.0, 0.0} : std::array{1.0 - s, s, 0.0};
  b.weight = b.count == 1 ? std::array{1.0, 0.0, 0.0} : std::array{1.0 - t, t, 0.0};
}

// A vertex that comes to a plane stays as far above it as it begins, or as it is wanted, and is held there.
void stop_at_plane(const Plane& plane, ImpactSide vertex, double wanted) {
  const Vec3 normal{plane.normal.x(), plane.normal.y(), plane.normal.z()};
  const auto height = [&](double time) { return dot(normal, vertex.at(time)) - plane.offset; };
  const double give = vertex.give(), missing = std::min(height(0.0), wanted) - height(1.0);
  if (!(give > 0.0) || !(missing > 0.0)) return;
  const Vec3 slide = vertex.at(1.0) - vertex.at(0.0), sideways = slide - dot(slide, normal) * normal;
  const double length = norm(sideways);
  const double held = length > 0.0 ? std::min(1.0, vertex.body.friction * missing / length) : 0.0;
  vertex.move((1.0 / give) * (missing * normal - held * sideways));
}

}  // namespace

void ImpactResponse::stop(const Impact& impact, double rest_offsets, const Positions& begin,
                          std::vector<Body>& bodies) const {
  if (const auto& plane = bodies[impact.a.index].plane)
    return stop_at_plane(*plane, side_of(bodies[impact.b.index], begin[impact.b.index], impact.b_vertices),
                         rest_offsets);
  if (const auto& plane = bodies[impact.b.index].plane)
    return stop_at_plane(*plane, side_of(bodies[impact.a.index], begin[impact.a.index], impact.a_vertices),
                         rest_offsets);
  ImpactSide a = side_of(bodies[impact.a.index], begin[impact.a.index], impact.a_vertices);
  ImpactSide b = side_of(bodies[impact.b.index], begin[impact.b.index], impact.b_vertices);
  weigh(a, b, impact.time);
  const double give = a.give() + b.give();
  const Vec3 between = b.at(impact.time) - a.at(impact.time);
  const double gap = norm(between);
  if (!(give > 0.0) || !(gap > 0.0)) return;
  const Vec3 normal = (1.0 / gap) * between;
  // Where the normal is that of the impact the two stay as far apart as they were in it, or as they begin.
  const double kept = std::max(gap, std::min(dot(normal, b.at(0.0) - a.at(0.0)), rest_offsets));
  const double missing = kept - dot(normal, b.at(1.0) - a.at(1.0));
  if (!(missing > 0.0)) return;
  const Vec3 slide = (b.at(1.0) - a.at(1.0)) - (b.at(0.0) - a.at(0.0));
  const Vec3 sideways = slide - dot(slide, normal) * normal;
  const double friction = std::sqrt(a.body.friction * b.body.friction), length = norm(sideways);
  const double held = length > 0.0 ? std::min(1.0, friction * missing / length) : 0.0;
  const Vec3 momentum = (1.0 / give) * (missing * normal - held * sideways);
  a.move(-momentum);
  b.move(momentum);
}

const MotionReport& ImpactResponse::detect(Impacts wanted, const std::vector<BodyId>& ids,
                                           const std::vector<Body>& bodies, World& world) {
  updates_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].motion != Motion::fixed) updates_.push_back({ids[i], as_matrix(bodies[i].positions)});
  }
  world.set_positions(updates_);
  return world.detect_motion(wanted);
}

void ImpactResponse::let_all_go_a_part(const Positions& begin, double part, std::vector<Body>& bodies) {
  part_ *= part;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t v = 0; v < begin[i].size(); ++v)
      bodies[i].positions[v] = begin[i][v] + part * (bodies[i].positions[v] - begin[i][v]);
  }
}

bool ImpactResponse::take_back(std::span<const Impact> impacts, const Positions& begin, std::vector<Body>& bodies) {
  const std::int64_t before = stayed_;
  const auto take = [&](BodyId body, const std::array<int, 3>& vertices) {
    for (const int v : vertices) {
      if (v < 0) continue;
      Vec3& position = bodies[body.index].positions[v];
      const Vec3 from = begin[body.index][v];
      if (position.x == from.x && position.y == from.y && position.z == from.z) continue;
      position = from;
      ++stayed_;
    }
  };
  for (const Impact& impact : impacts) {
    if (!impact.stops) continue;
    take(impact.a, impact.a_vertices);
    take(impact.b, impact.b_vertices);
  }
  return stayed_ > before;
}

void ImpactResponse::run(const Positions& begin, double seconds, LastResort last_resort, const std::vector<BodyId>& ids,
                         std::vector<Body>& bodies, World& world) {
  wanted_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) wanted_[i] = bodies[i].positions;
  impacts_ = stayed_ = 0;
  part_ = 1.0;
  bool is_free = false;
  const int rounds = last_resort == LastResort::all_stop ? kMostRounds : kFewRounds;
  for (int round = 0; round < rounds && !is_free; ++round) {
    const MotionReport& motion = detect(Impacts::all, ids, bodies, world);
    is_free = motion.first_time() > 1.0;
    impacts_ += std::ranges::count_if(motion.impacts(), &Impact::stops);
    for (const Impact& impact : motion.impacts())
      if (impact.stops) stop(impact, world.rest_offset(impact.a) + world.rest_offset(impact.b), begin, bodies);
  }
  while (!is_free && last_resort == LastResort::all_stop) {
    const double first = detect(Impacts::first, ids, bodies, world).first_time();
    is_free = first > 1.0;
    if (!is_free) let_all_go_a_part(begin, kPart * first, bodies);
  }
  // Each round takes a vertex back that was not, or is the last one.
  while (!is_free) is_free = !take_back(detect(Impacts::all, ids, bodies, world).impacts(), begin, bodies);
  if (impacts_ == 0) return;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t v = 0; v < begin[i].size(); ++v) {
      if (bodies[i].inverse_masses[v] > 0.0)
        bodies[i].velocities[v] = bodies[i].velocities[v] + (1.0 / seconds) * (bodies[i].positions[v] - wanted_[i][v]);
    }
  }
}

}  // namespace tact::scenes
