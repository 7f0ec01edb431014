#include "scenes/dynamics/contact_solver.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/base/parallel.h"

namespace tact::scenes {
namespace {

constexpr int kMostGroups = 64;  // bits of a word
// Where the other body moves by a script no retreat may be enough.
constexpr int kMostRetreats = 40;

}  // namespace

// A place that a body carries.
class ContactSolver::Carrier {
 public:
  Carrier(Body& body, const std::vector<Vec3>& before, const Place& place)
      : body_(body), before_(before), place_(place), arm_(body.rigid ? body.rigid->arm(place.local) : Vec3{}) {}

  Vec3 now() const { return body_.plane ? place_.local : body_.rigid ? body_.rigid->now(arm_) : at(body_.positions); }
  Vec3 before() const { return body_.plane ? place_.local : body_.rigid ? body_.rigid->before(arm_) : at(before_); }
  // How far a unit impulse along `direction` moves the place along it.
  double give(Vec3 direction) const {
    if (!body_.movable()) return 0.0;
    if (body_.rigid) return body_.rigid->give(arm_, direction);
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += place_.weights[k] * place_.weights[k] * body_.inverse_masses[place_.vertices[k]];
    return sum;
  }
  void push(Vec3 impulse) {
    if (!body_.movable()) return;  // several contacts of a group may read what does not move
    if (body_.rigid) {
      body_.rigid->push(arm_, impulse);
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(place_.vertices[k]);
      body_.positions[vertex] = body_.positions[vertex] + (place_.weights[k] * body_.inverse_masses[vertex]) * impulse;
    }
  }
  // Half of the way since the substep began is taken back.
  void retreat() {
    if (!body_.movable()) return;
    if (body_.rigid) {
      body_.rigid->retreat();
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(place_.vertices[k]);
      if (place_.weights[k] > 0.0 && body_.inverse_masses[vertex] > 0.0)
        body_.positions[vertex] = 0.5 * (body_.positions[vertex] + before_[vertex]);
    }
  }

 private:
  Vec3 at(const std::vector<Vec3>& positions) const {
    Vec3 sum;
    for (std::size_t k = 0; k < 3; ++k) sum = sum + place_.weights[k] * positions[place_.vertices[k]];
    return sum;
  }

  Body& body_;
  const std::vector<Vec3>& before_;
  const Place& place_;
  Vec3 arm_;
};

ContactSolver::Place ContactSolver::place_of(const Body& body, const std::array<int, 3>& vertices,
                                             const std::array<double, 3>& weights) {
  Place place;
  if (body.plane) {
    const auto& [normal, offset] = *body.plane;
    place.local = offset * Vec3{normal.x(), normal.y(), normal.z()};
    return place;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const bool used = vertices[k] >= 0;
    place.vertices[k] = used ? vertices[k] : vertices[0];
    place.weights[k] = used ? weights[k] : 0.0;
    if (body.rigid) place.local = place.local + place.weights[k] * body.rigid->local()[place.vertices[k]];
  }
  return place;
}

void ContactSolver::take(const Report& report, const std::vector<Body>& bodies, int threads) {
  const auto contacts = report.contacts();
  contacts_.clear();
  std::vector<const Contact*> taken;
  std::size_t count = 0;
  for (const Contact& contact : contacts) {
    const std::size_t a = contact.a.index, b = contact.b.index, size = contact.points().size();
    if (size == 0 || !(bodies[a].movable() || bodies[b].movable())) continue;
    contacts_.push_back({a, b, count, count + size});
    taken.push_back(&contact);
    count += size;
  }
  points_.resize(count);
  base::parallel_for(taken.size(), 64, threads, [&](std::size_t i) {
    const Body &a = bodies[contacts_[i].a], &b = bodies[contacts_[i].b];
    Point* out = points_.data() + contacts_[i].begin;
    for (const ContactPoint& point : taken[i]->points()) {
      *out++ = {.a = place_of(a, point.a_vertices, point.a_weights),
                .b = place_of(b, point.b_vertices, point.b_weights),
                .normal = {point.normal.x(), point.normal.y(), point.normal.z()},
                .wanted = a.thickness + b.thickness,
                .found = std::min(a.thickness + b.thickness, point.gap),
                .apart = std::min(a.thickness + b.thickness, point.gap)};
    }
  });
  group_contacts(bodies);
}

void ContactSolver::group_contacts(const std::vector<Body>& bodies) {
  groups_.clear();
  rest_.clear();
  std::vector<std::uint64_t> taken(bodies.size(), 0);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const auto [a, b, begin, end] = contacts_[i];
    const std::uint64_t both = (bodies[a].movable() ? taken[a] : 0) | (bodies[b].movable() ? taken[b] : 0);
    const int group = std::countr_one(both);
    if (group == kMostGroups) {
      rest_.push_back(i);
      continue;
    }
    taken[a] |= std::uint64_t{1} << group;
    taken[b] |= std::uint64_t{1} << group;
    groups_.resize(std::max(groups_.size(), static_cast<std::size_t>(group) + 1));
    groups_[group].push_back(i);
  }
}

void ContactSolver::push(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
                         const ContactSettings& settings, double h, int threads) {
  for (Point& point : points_) {
    const double missing = point.wanted - point.apart;
    point.apart += std::min(settings.parting_share * missing, settings.parting_speed * h);
  }
  for (int k = 0; k < settings.most_sweeps; ++k) {
    if (!sweep({.spare = k == 0 ? 0.0 : settings.spare}, bodies, before, threads)) break;
  }
}

void ContactSolver::retreat(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
                            const ContactSettings& settings, int threads) {
  const Sweep retreat{
      .kind = Sweep::Kind::retreat, .least_share = settings.least_share, .least_gap = settings.least_gap};
  for (int k = 0; k < kMostRetreats; ++k) {
    if (!sweep(retreat, bodies, before, threads)) break;
  }
}

bool ContactSolver::sweep(const Sweep& sweep, std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
                          int threads) {
  std::atomic<bool> any = false;
  const auto sweep_one = [&](std::size_t contact) {
    if (sweep_contact(contacts_[contact], sweep, bodies, before)) any = true;
  };
  for (const std::vector<std::size_t>& group : groups_)
    base::parallel_for(group.size(), 32, threads, [&](std::size_t i) { sweep_one(group[i]); });
  for (const std::size_t i : rest_) sweep_one(i);
  return any;
}

bool ContactSolver::sweep_contact(const BodyContact& contact, const Sweep& sweep, std::vector<Body>& bodies,
                                  const std::vector<std::vector<Vec3>>& before) const {
  Body &body_a = bodies[contact.a], &body_b = bodies[contact.b];
  const double friction = std::sqrt(body_a.friction * body_b.friction);
  bool any = false;
  for (std::size_t i = contact.begin; i < contact.end; ++i) {
    const Point& point = points_[i];
    Carrier a(body_a, before[contact.a], point.a), b(body_b, before[contact.b], point.b);
    const double distance = dot(point.normal, b.now() - a.now());
    if (sweep.kind == Sweep::Kind::push) {
      const double missing = point.apart - distance;
      if (missing > sweep.spare * point.wanted) any = push_point(point, missing, a, b, friction) || any;
    } else if (point.found > 0.0 && distance < std::min(point.found, std::max(sweep.least_share * point.found,
                                                                              sweep.least_gap * point.wanted))) {
      a.retreat();
      b.retreat();
      any = true;
    }
  }
  return any;
}

bool ContactSolver::push_point(const Point& point, double missing, Carrier& a, Carrier& b, double friction) {
  const double give = a.give(point.normal) + b.give(point.normal);
  if (!(give > 0.0)) return false;
  const double impulse = missing / give;
  a.push(-impulse * point.normal);
  b.push(impulse * point.normal);

  Vec3 slid = (b.now() - b.before()) - (a.now() - a.before());
  slid = slid - dot(slid, point.normal) * point.normal;
  const double length = norm(slid);
  if (!(length > 0.0)) return true;
  const Vec3 along = (1.0 / length) * slid;
  const double back = std::min(length / (a.give(along) + b.give(along)), friction * impulse);
  a.push(back * along);
  b.push(-back * along);
  return true;
}

}  // namespace tact::scenes
