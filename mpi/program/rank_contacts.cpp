#include "mpi/program/rank_contacts.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/parallel.h"
#include "scenes/dynamics/sleep.h"

namespace tact::mpi::program {
namespace {

constexpr std::size_t kPlacedAtATime = 4;
// What is too near is taken back half of its way so often, then all of it: there it was not too near. As others are
// taken back, too, that ends.
constexpr int kHalves = 3;
constexpr int kMostRetreats = 40;

// What a point says of the side 0 or 1 of its contact.
struct PointSide {
  const std::array<int, 3>& vertices;
  const std::array<double, 3>& weights;
};

PointSide side_of(const ContactPoint& point, int side) {
  return side == 0 ? PointSide{point.a_vertices, point.a_weights} : PointSide{point.b_vertices, point.b_weights};
}

// Calls work(vertex, weight) for the vertices that carry the place.
template <class Work>
void for_each_vertex(const PointSide& side, const Work& work) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (side.vertices[k] >= 0 && side.weights[k] > 0.0)
      work(static_cast<std::size_t>(side.vertices[k]), side.weights[k]);
  }
}

Vec3 place_at(const std::vector<Vec3>& positions, const PointSide& side) {
  Vec3 sum;
  for_each_vertex(side, [&](std::size_t v, double weight) { sum = sum + weight * positions[v]; });
  return sum;
}

}  // namespace

void RankContacts::take(std::vector<SharedContact> contacts, const std::vector<Body>& bodies) {
  contacts_ = std::move(contacts);
  partners_.assign(2 * contacts_.size(), {});
  sort_sides(bodies);
  find_neighbors();
  share_partners(bodies);
  first_point_.assign(1, 0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!partner(c, 0).moves && !partner(c, 1).moves) contacts_[c].points = {};
    first_point_.push_back(first_point_.back() + contacts_[c].points.size());
  }
  places_.assign(2 * first_point_.back(), {});
  apart_.resize(first_point_.back());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    for (std::size_t i = 0; i < contacts_[c].points.size(); ++i)
      apart_[first_point_[c] + i] = std::min(thickness(c), contacts_[c].points[i].gap);
  }
  count_pushes(bodies);
}

void RankContacts::sort_sides(const std::vector<Body>& bodies) {
  first_side_.assign(bodies.size() + 1, 0);
  const auto for_each_side = [&](const auto& work) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      for (int side = 0; side < 2; ++side) {
        if (contacts_[c].body[side] != SharedContact::kElsewhere)
          work(static_cast<std::size_t>(contacts_[c].body[side]), OwnSide{c, side});
      }
    }
  };
  for_each_side([&](std::size_t body, const OwnSide&) { ++first_side_[body + 1]; });
  for (std::size_t body = 0; body < bodies.size(); ++body) first_side_[body + 1] += first_side_[body];
  sides_.resize(first_side_.back());
  std::vector<std::size_t> next(first_side_.begin(), first_side_.end() - 1);
  for_each_side([&](std::size_t body, const OwnSide& side) { sides_[next[body]++] = side; });
}

// Before the first sweep every point may push.
void RankContacts::count_pushes(const std::vector<Body>& bodies) {
  pushes_.resize(bodies.size());
  shifts_.resize(bodies.size());
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    pushes_[body].assign(bodies[body].positions.size(), 0);
    shifts_[body].assign(bodies[body].positions.size(), {});
    for (const OwnSide& side : sides_of(body)) {
      for (const ContactPoint& point : contacts_[side.contact].points)
        for_each_vertex(side_of(point, side.side), [&](std::size_t v, double) { ++pushes_[body][v]; });
    }
  }
}

std::span<const RankContacts::OwnSide> RankContacts::sides_of(std::size_t body) const {
  return std::span(sides_).subspan(first_side_[body], first_side_[body + 1] - first_side_[body]);
}

void RankContacts::find_neighbors() {
  std::map<int, std::vector<OwnSide>> sides;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const SharedContact& contact = contacts_[c];
    if (contact.rank != SharedContact::kElsewhere)
      sides[contact.rank].push_back({c, contact.body[0] != SharedContact::kElsewhere ? 0 : 1});
  }
  neighbors_.clear();
  for (auto& [rank, of_rank] : sides) neighbors_.push_back({.rank = rank, .sides = std::move(of_rank)});
}

template <class Give, class Take>
void RankContacts::exchange(Items items, int width, const Give& give, const Take& take) {
  const auto for_each_item = [&](const Neighbor& neighbor, const auto& work) {
    std::size_t at = 0;
    for (const auto& [contact, side] : neighbor.sides) {
      const std::size_t begin = items == Items::contacts ? contact : first_point_[contact],
                        end = items == Items::contacts ? contact + 1 : first_point_[contact + 1];
      for (std::size_t item = begin; item < end; ++item, at += static_cast<std::size_t>(width)) work(item, side, at);
    }
    return at;
  };
  std::vector<MPI_Request> requests;
  for (Neighbor& neighbor : neighbors_) {
    const std::size_t count = for_each_item(neighbor, [](std::size_t, int, std::size_t) {});
    neighbor.sent.resize(count);
    neighbor.received.resize(count);
    for_each_item(neighbor,
                  [&](std::size_t item, int side, std::size_t at) { give(item, side, neighbor.sent.data() + at); });
    const int size = static_cast<int>(count);
    MPI_Irecv(neighbor.received.data(), size, MPI_DOUBLE, neighbor.rank, 0, communicator_,
              &requests.emplace_back(MPI_REQUEST_NULL));
    MPI_Isend(neighbor.sent.data(), size, MPI_DOUBLE, neighbor.rank, 0, communicator_,
              &requests.emplace_back(MPI_REQUEST_NULL));
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (const Neighbor& neighbor : neighbors_) {
    for_each_item(neighbor, [&](std::size_t item, int side, std::size_t at) {
      take(item, 1 - side, neighbor.received.data() + at);
    });
  }
}

void RankContacts::share_partners(const std::vector<Body>& bodies) {
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    const Body& b = bodies[body];
    const Partner partner{.thickness = b.thickness,
                          .friction = b.friction,
                          .square_speed = scenes::mean_square_speed(b),
                          .dynamic = b.dynamic,
                          .moves = b.motion != Motion::fixed && !b.asleep};
    for (const OwnSide& side : sides_of(body)) partners_[2 * side.contact + side.side] = partner;
  }
  exchange(
      Items::contacts, 5,
      [&](std::size_t contact, int side, double* out) {
        const Partner& p = partner(contact, side);
        const std::array<double, 5> values{p.thickness, p.friction, p.square_speed, p.dynamic ? 1.0 : 0.0,
                                           p.moves ? 1.0 : 0.0};
        std::ranges::copy(values, out);
      },
      [&](std::size_t contact, int side, const double* in) {
        partners_[2 * contact + side] = {in[0], in[1], in[2], in[3] > 0.0, in[4] > 0.0};
      });
}

void RankContacts::share_places(const std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
                                Known known) {
  base::parallel_for(bodies.size(), kPlacedAtATime, threads_, [&](std::size_t body) {
    const Body& b = bodies[body];
    const std::vector<Vec3>& then = b.movable() ? before[body] : b.positions;
    for (const OwnSide& side : sides_of(body)) {
      const std::span<const ContactPoint> points = contacts_[side.contact].points;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const PointSide of_point = side_of(points[i], side.side);
        Place& p = place(first_point_[side.contact] + i, side.side);
        p = {.now = place_at(b.positions, of_point), .before = place_at(then, of_point)};
        if (!b.movable()) continue;
        for_each_vertex(of_point, [&](std::size_t v, double weight) {
          p.give += weight * weight * b.inverse_masses[v] * std::max(pushes_[body][v], 1);
        });
      }
    }
  });
  exchange(
      Items::points, known == Known::before ? 4 : 7,
      [&](std::size_t point, int side, double* out) {
        const Place& p = place(point, side);
        out[0] = p.now.x, out[1] = p.now.y, out[2] = p.now.z, out[3] = p.give;
        if (known == Known::nothing) out[4] = p.before.x, out[5] = p.before.y, out[6] = p.before.z;
      },
      [&](std::size_t point, int side, const double* in) {
        Place& p = place(point, side);
        p.now = {in[0], in[1], in[2]}, p.give = in[3];
        if (known == Known::nothing) p.before = {in[4], in[5], in[6]};
      });
}

void RankContacts::push(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
                        const scenes::ContactSettings& settings, double h) {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    for (std::size_t p = first_point_[c]; p < first_point_[c + 1]; ++p)
      apart_[p] += std::min(settings.parting_share * (thickness(c) - apart_[p]), settings.parting_speed * h);
  }
  for (int k = 0; k < settings.most_sweeps; ++k) {
    share_places(bodies, before, k == 0 ? Known::nothing : Known::before);
    base::parallel_for(bodies.size(), kPlacedAtATime, threads_, [&](std::size_t body) {
      if (bodies[body].movable()) push_body(body, bodies[body], k == 0 ? 0.0 : settings.spare);
    });
  }
}

// What the point asks of body b, the opposite of body a; zero where it has what it asks for.
Vec3 RankContacts::impulse(std::size_t contact, std::size_t i, double spare) const {
  const ContactPoint& point = contacts_[contact].points[i];
  const std::size_t p = first_point_[contact] + i;
  const Place &a = place(p, 0), &b = place(p, 1);
  const Vec3 normal{point.normal.x(), point.normal.y(), point.normal.z()};
  const double missing = apart_[p] - dot(normal, b.now - a.now), give = a.give + b.give;
  if (!(missing > spare * thickness(contact)) || !(give > 0.0)) return {};
  const double along_normal = missing / give;
  Vec3 slid = (b.now - b.before) - (a.now - a.before);
  slid = slid - dot(slid, normal) * normal;
  const double length = norm(slid);
  if (!(length > 0.0)) return along_normal * normal;
  const double friction = std::sqrt(partner(contact, 0).friction * partner(contact, 1).friction);
  const double back = std::min(length / give, friction * along_normal);
  return along_normal * normal - (back / length) * slid;
}

void RankContacts::push_body(std::size_t body, Body& moved, double spare) {
  std::vector<Vec3>& shifts = shifts_[body];
  std::vector<int>& pushes = pushes_[body];
  std::ranges::fill(shifts, Vec3{});
  std::ranges::fill(pushes, 0);
  for (const auto& [contact, side] : sides_of(body)) {
    const std::span<const ContactPoint> points = contacts_[contact].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec3 push = impulse(contact, i, spare);
      if (push == Vec3{}) continue;
      if (side == 0) push = -push;
      for_each_vertex(side_of(points[i], side), [&](std::size_t v, double weight) {
        shifts[v] = shifts[v] + (weight * moved.inverse_masses[v]) * push;
        ++pushes[v];
      });
    }
  }
  for (std::size_t v = 0; v < shifts.size(); ++v) {
    if (pushes[v] > 0) moved.positions[v] = moved.positions[v] + shifts[v];
  }
}

void RankContacts::retreat(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
                           const scenes::ContactSettings& settings) {
  for (int k = 0; k < kMostRetreats; ++k) {
    share_places(bodies, before, Known::before);
    const double kept = k < kHalves ? 0.5 : 0.0;
    std::atomic<int> any = 0;
    base::parallel_for(bodies.size(), kPlacedAtATime, threads_, [&](std::size_t body) {
      if (bodies[body].movable() && take_back_body(body, bodies[body], before[body], settings, kept)) any = 1;
    });
    int of_all = any;
    MPI_Allreduce(MPI_IN_PLACE, &of_all, 1, MPI_INT, MPI_MAX, communicator_);
    if (of_all == 0) break;
  }
}

// Vertices whose points are too near keep so much of their way. False if there are none.
bool RankContacts::take_back_body(std::size_t body, Body& moved, const std::vector<Vec3>& before,
                                  const scenes::ContactSettings& settings, double kept) {
  std::vector<char> near(moved.positions.size(), 0);
  bool any = false;
  for (const auto& [contact, side] : sides_of(body)) {
    const std::span<const ContactPoint> points = contacts_[contact].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ContactPoint& point = points[i];
      const std::size_t p = first_point_[contact] + i;
      const Vec3 normal{point.normal.x(), point.normal.y(), point.normal.z()};
      const double wanted = thickness(contact), found = std::min(wanted, point.gap);
      const double least = std::min(found, std::max(settings.least_share * found, settings.least_gap * wanted));
      if (!(found > 0.0 && dot(normal, place(p, 1).now - place(p, 0).now) < least)) continue;
      for_each_vertex(side_of(point, side), [&](std::size_t v, double) { near[v] = 1; });
      any = true;
    }
  }
  for (std::size_t v = 0; v < near.size(); ++v) {
    if (near[v] != 0) moved.positions[v] = before[v] + kept * (moved.positions[v] - before[v]);
  }
  return any;
}

}  // namespace tact::mpi::program
