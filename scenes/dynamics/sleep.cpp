#include "scenes/dynamics/sleep.h"

#include <algorithm>

namespace tact::scenes {
namespace {

void watch(const Body& body, double seconds, double room, Rest& rest) {
  const std::size_t last = body.positions.size() - 1;
  const std::array<Vec3, 3> now{body.positions[0], body.positions[last / 2], body.positions[last]};
  rest.near += seconds;
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (norm_squared(now[k] - rest.places[k]) > room * room) rest.places = now, rest.near = 0.0;
  }
}

}  // namespace

double mean_square_speed(const Body& body) {
  if (body.motion == Motion::fixed || body.asleep) return 0.0;
  if (body.dynamic) return 2.0 * kinetic_energy(body) / mass(body);
  double most = 0.0;  // a script may move a part of it only
  for (const Vec3& velocity : body.velocities) most = std::max(most, norm_squared(velocity));
  return most;
}

bool presses(const Contact& contact, double thickness) {
  return std::ranges::any_of(contact.points(), [&](const ContactPoint& p) { return p.gap < 1.1 * thickness; });
}

bool disturbs(double square, bool dynamic, const SleepSettings& settings) {
  const double fast = settings.speed * settings.speed * settings.wake * settings.wake;
  return square > (dynamic ? fast : 0.0);
}

void settle(Body& body, Rest& rest, double square, bool disturbed, double seconds, const SleepSettings& settings) {
  constexpr double kRoomTime = 1.0;  // seconds
  if (!body.dynamic) return;
  rest.still = square < settings.speed * settings.speed ? rest.still + seconds : 0.0;
  if (body.movable() && settings.room > 0.0) watch(body, seconds, settings.room, rest);
  if (body.asleep && disturbed) {
    body.asleep = false;
    rest.still = rest.near = 0.0;
  } else if (!body.asleep && !disturbed && (rest.still >= settings.time || rest.near >= kRoomTime)) {
    body.asleep = true;
    std::ranges::fill(body.velocities, Vec3{});
    if (body.rigid) body.rigid->stop();
  }
}

void Sleep::update(const Report& report, double seconds, const SleepSettings& settings, std::vector<Body>& bodies) {
  if (!(settings.speed > 0.0)) return;
  rests_.resize(bodies.size());
  squares_.resize(bodies.size());
  disturbed_.assign(bodies.size(), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) squares_[i] = mean_square_speed(bodies[i]);
  for (const Contact& contact : report.contacts()) {
    const std::size_t a = contact.a.index, b = contact.b.index;
    const bool b_disturbs = bodies[a].dynamic && disturbs(squares_[b], bodies[b].dynamic, settings),
               a_disturbs = bodies[b].dynamic && disturbs(squares_[a], bodies[a].dynamic, settings);
    if (!(a_disturbs || b_disturbs)) continue;
    const bool both_dynamic = bodies[a].dynamic && bodies[b].dynamic;
    if (both_dynamic && !presses(contact, bodies[a].thickness + bodies[b].thickness)) continue;
    if (b_disturbs) disturbed_[a] = 1;
    if (a_disturbs) disturbed_[b] = 1;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    settle(bodies[i], rests_[i], squares_[i], disturbed_[i] != 0, seconds, settings);
}

}  // namespace tact::scenes
