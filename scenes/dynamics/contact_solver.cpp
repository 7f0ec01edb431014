#include "scenes/dynamics/contact_solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/base/parallel.h"

namespace tact::scenes {
namespace {

constexpr int kMostGroups = 64;

Vec3 x_point(const SurfacePoint& point, const std::vector<Vec3>& positions) {
  return point.x_weights[0] * positions[static_cast<std::size_t>(point.x_vertices[0])] +
         point.x_weights[1] * positions[static_cast<std::size_t>(point.x_vertices[1])];
}

Vec3 y_point(const SurfacePoint& point, const std::vector<Vec3>& positions) {
  return point.y_weights[0] * positions[static_cast<std::size_t>(point.y_vertices[0])] +
         point.y_weights[1] * positions[static_cast<std::size_t>(point.y_vertices[1])] +
         point.y_weights[2] * positions[static_cast<std::size_t>(point.y_vertices[2])];
}

// Sum of w² / m over the vertices of a point.
template <class Vertices, class Weights>
double give(const Vertices& vertices, const Weights& weights, const std::vector<double>& inverse_masses) {
  double sum = 0.0;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    sum += weights[k] * weights[k] * inverse_masses[static_cast<std::size_t>(vertices[k])];
  }
  return sum;
}

template <class Vertices, class Weights>
void move(const Vertices& vertices, const Weights& weights, Vec3 impulse, Body& body) {
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto vertex = static_cast<std::size_t>(vertices[k]);
    if (!(body.inverse_masses[vertex] > 0.0)) continue;  // several contacts of a group may read what does not move
    body.positions[vertex] = body.positions[vertex] + (weights[k] * body.inverse_masses[vertex]) * impulse;
  }
}

double height(const SurfacePoint& point, const Body& x, const Body& y) {
  return dot(point.normal, x_point(point, x.positions) - y_point(point, y.positions));
}

void start_points(std::vector<SurfacePoint>& points, const Body& x, const Body& y, double slop) {
  for (SurfacePoint& point : points) point.offset = height(point, x, y) + (point.depth - slop);
}

void hold_points(std::vector<SurfacePoint>& points, const Body& x, const Body& y) {
  for (SurfacePoint& point : points) point.offset = std::min(point.offset, height(point, x, y));
}

struct Sides {
  Body& x;
  Body& y;
  const std::vector<Vec3>* x_before;  // null: no friction
  const std::vector<Vec3>* y_before;
  double friction;
  WayOut part;  // most in metres
};

void solve_point(const SurfacePoint& point, const Sides& sides) {
  const Vec3 between = x_point(point, sides.x.positions) - y_point(point, sides.y.positions);
  const double inside = point.offset - dot(point.normal, between);
  if (!(inside > 0.0)) return;
  const double both = give(point.x_vertices, point.x_weights, sides.x.inverse_masses) +
                      give(point.y_vertices, point.y_weights, sides.y.inverse_masses);
  if (!(both > 0.0)) return;
  Vec3 way = std::min(sides.part.share * inside, sides.part.most) * point.normal;
  if (sides.x_before != nullptr) {
    const Vec3 since = between - (x_point(point, *sides.x_before) - y_point(point, *sides.y_before));
    const Vec3 slid = since - dot(since, point.normal) * point.normal;
    const double length = norm(slid);
    const double most = sides.friction * inside;
    if (length > 0.0) way = way - (length > most ? most / length : 1.0) * slid;
  }
  const Vec3 impulse = (1.0 / both) * way;
  move(point.x_vertices, point.x_weights, impulse, sides.x);
  move(point.y_vertices, point.y_weights, -impulse, sides.y);
}

}  // namespace

void ContactSolver::start(std::vector<BodyContact>& contacts, const std::vector<Body>& bodies, double slop) {
  contacts_ = &contacts;
  groups_.clear();
  rest_.clear();
  std::vector<std::uint64_t> taken(bodies.size(), 0);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    BodyContact& contact = contacts[i];
    const auto a = static_cast<std::size_t>(contact.a);
    const auto b = static_cast<std::size_t>(contact.b);
    start_points(contact.a_in_b, bodies[a], bodies[b], slop);
    start_points(contact.b_in_a, bodies[b], bodies[a], slop);
    const std::uint64_t both = (bodies[a].dynamic ? taken[a] : 0) | (bodies[b].dynamic ? taken[b] : 0);
    const int group = std::countr_one(both);
    if (group == kMostGroups) {
      rest_.push_back(i);
      continue;
    }
    taken[a] |= std::uint64_t{1} << group;
    taken[b] |= std::uint64_t{1} << group;
    groups_.resize(std::max(groups_.size(), static_cast<std::size_t>(group) + 1));
    groups_[static_cast<std::size_t>(group)].push_back(i);
  }
}

void ContactSolver::solve(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before, int threads) {
  solve_contacts(bodies, &before, {}, threads);
}

void ContactSolver::push_out(std::vector<Body>& bodies, const WayOut& part, int threads) {
  solve_contacts(bodies, nullptr, part, threads);
}

void ContactSolver::hold(const std::vector<Body>& bodies) {
  if (contacts_ == nullptr) return;
  for (BodyContact& contact : *contacts_) {
    const Body& a = bodies[static_cast<std::size_t>(contact.a)];
    const Body& b = bodies[static_cast<std::size_t>(contact.b)];
    hold_points(contact.a_in_b, a, b);
    hold_points(contact.b_in_a, b, a);
  }
}

void ContactSolver::solve_contacts(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>* before,
                                   const WayOut& part, int threads) {
  if (contacts_ == nullptr) return;
  for (const std::vector<std::size_t>& group : groups_) {
    base::parallel_for(group.size(), 32, threads,
                       [&](std::size_t i) { solve_contact(bodies, before, part, (*contacts_)[group[i]]); });
  }
  for (const std::size_t i : rest_) solve_contact(bodies, before, part, (*contacts_)[i]);
}

void ContactSolver::solve_contact(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>* before,
                                  const WayOut& part, BodyContact& contact) const {
  const auto a = static_cast<std::size_t>(contact.a);
  const auto b = static_cast<std::size_t>(contact.b);
  const double friction = std::sqrt(bodies[a].friction * bodies[b].friction);
  const std::vector<Vec3>* before_a = before != nullptr ? &(*before)[a] : nullptr;
  const std::vector<Vec3>* before_b = before != nullptr ? &(*before)[b] : nullptr;
  const WayOut way{part.share, part.most * std::min(bodies[a].size, bodies[b].size)};
  for (const SurfacePoint& point : contact.a_in_b) {
    solve_point(point, {bodies[a], bodies[b], before_a, before_b, friction, way});
  }
  for (const SurfacePoint& point : contact.b_in_a) {
    solve_point(point, {bodies[b], bodies[a], before_b, before_a, friction, way});
  }
}

}  // namespace tact::scenes
