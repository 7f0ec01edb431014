#include "scenes/dynamics/sleep.h"

#include <algorithm>

namespace tact::scenes {
namespace {

double mean_square_speed(const Body& body) {
  if (body.motion == Motion::fixed || body.asleep) return 0.0;
  if (body.dynamic) return 2.0 * kinetic_energy(body) / mass(body);
  double most = 0.0;  // a script may move a part of it only
  for (const Vec3& velocity : body.velocities) most = std::max(most, norm_squared(velocity));
  return most;
}

bool touch(const Contact& contact, double thickness) {
  return std::ranges::any_of(contact.points(), [&](const ContactPoint& p) { return p.gap < 1.1 * thickness; });
}

}  // namespace

void Sleep::watch(const Body& body, double seconds, double room, Anchor& anchor) {
  const std::size_t last = body.positions.size() - 1;
  const std::array<Vec3, 3> now{body.positions[0], body.positions[last / 2], body.positions[last]};
  anchor.time += seconds;
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (norm_squared(now[k] - anchor.places[k]) > room * room) anchor = {now, 0.0};
  }
}

void Sleep::update(const Report& report, double seconds, const SleepSettings& settings, std::vector<Body>& bodies) {
  if (!(settings.speed > 0.0)) return;
  const double slow = settings.speed * settings.speed, fast = slow * settings.wake * settings.wake;
  constexpr double kRoomTime = 1.0;  // seconds
  still_.resize(bodies.size(), 0.0);
  anchors_.resize(bodies.size());
  squares_.resize(bodies.size());
  restless_.assign(bodies.size(), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    squares_[i] = mean_square_speed(bodies[i]);
    still_[i] = squares_[i] < slow ? still_[i] + seconds : 0.0;
    if (bodies[i].movable() && settings.room > 0.0) watch(bodies[i], seconds, settings.room, anchors_[i]);
  }
  for (const Contact& contact : report.contacts()) {
    const std::size_t a = contact.a.index, b = contact.b.index;
    const bool b_disturbs = bodies[a].dynamic && squares_[b] > (bodies[b].dynamic ? fast : 0.0),
               a_disturbs = bodies[b].dynamic && squares_[a] > (bodies[a].dynamic ? fast : 0.0);
    if (!(a_disturbs || b_disturbs)) continue;
    const bool both_dynamic = bodies[a].dynamic && bodies[b].dynamic;
    if (both_dynamic && !touch(contact, bodies[a].thickness + bodies[b].thickness)) continue;
    if (b_disturbs) restless_[a] = 1;
    if (a_disturbs) restless_[b] = 1;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.dynamic) continue;
    if (body.asleep && restless_[i]) {
      body.asleep = false;
      still_[i] = anchors_[i].time = 0.0;
    } else if (!body.asleep && !restless_[i] && (still_[i] >= settings.time || anchors_[i].time >= kRoomTime)) {
      body.asleep = true;
      std::ranges::fill(body.velocities, Vec3{});
      if (body.rigid) body.rigid->stop();
    }
  }
}

}  // namespace tact::scenes
