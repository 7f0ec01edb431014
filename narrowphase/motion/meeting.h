// When a moving polygon first holds the origin, or comes within a reach of it.
//
// What is proved. A span of time is left out only with a certificate that the polygon stays away throughout:
//   - a direction n(t), linear in t, with n(t) · corner(t) > reach for every corner;
//   - the volume that the corners span with the origin, cubic in t, keeps its sign and stays above reach times area; or
//   - the origin is beyond one side of the polygon, as a polynomial of degree four says (finest_span.h).
// Each is a polynomial whose Bernstein coefficients on the span bound it from below (their rounding is added to what
// they have to exceed), so no root is ever looked for: one that is missed cannot occur. Where n(t) comes from does not
// matter for that. Spans without a certificate are halved, the earlier half first. Where the polygon is as near as
// doubles can tell, or the span is as short as kFinestSpan of the step, double_doubles go on; what is left then counts
// as a meeting, at its beginning. A corner that goes exactly through the origin is a meeting: all that is left to prove
// is that none comes before. Hence
//   - a time is never later than the true one;
//   - a polygon that misses the origin, or stays beyond the reach, by more than 1e-11 of its size and way never counts,
//     and most often one that misses the origin by 1e-25;
//   - a time is earlier than the true one by more than kFinestSpan only if the polygon comes as near as that before.
// The idea of bounding instead of solving, for boxes of parameters: Wang, Ferguson, Schneider, Jiang, Attene, Panozzo,
// "A large-scale benchmark and an inclusion-based algorithm for continuous collision detection", 2021.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "narrowphase/motion/finest_span.h"
#include "narrowphase/motion/moving_polygon.h"

namespace tact::narrowphase {

struct Meeting {
  static constexpr double kNever = __builtin_inf();
  double time = kNever;    // in [0, 1]
  std::int64_t spans = 0;  // that were looked at
};

/// For a polygon that starts nearer than `reach`, or by less than kJustAbove of it above, the reach is this share of
/// its distance at the start. Who stops before each meeting comes to lie just above the reach, and is not stopped there
/// again.
inline constexpr double kShareOfGap = 0.1;
inline constexpr double kJustAbove = 0x1p-10;

/// When polygons first come within a reach of the origin. One for each thread; its memory is reused.
class MeetingSearch {
 public:
  MeetingSearch();

  /// `reach` in metres, zero or more. Once all times up to `latest` are left out, the search ends and the answer is
  /// never. It takes the same steps whatever `latest` is. What is before `begin` does not count.
  Meeting first(const MovingPolygon& polygon, double reach, double latest = 1.0, double begin = 0.0);

  /// How far a polygon is from the origin at time 0, in metres, or up to 2^-46 of its size and way less.
  double distance_at_begin(const MovingPolygon& polygon);

 private:
  // The polygon at a time between 0 and 1.
  struct Moment {
    double time = 0.0;
    Vec3 corner[4];
    Vec3 direction;        // unit or zero: from the origin to the nearest point of the polygon
    bool covered = false;  // all time since the moment before is left out
  };
  // The volume that the corners span with the origin: Bernstein coefficients on a span, and a bound of their rounding.
  struct Volume {
    std::array<double, 4> coefficient;
    double rounding;

    bool vanishes() const;  // as far as doubles tell
  };
  struct Span {
    double from, to;
  };
  double take(const MovingPolygon& polygon);
  Volume volume_on(const Vec3 (&from)[4], const Vec3 (&to)[4]) const;
  bool is_decided_at_once(const MovingPolygon& polygon, Span& span, Meeting& meeting);
  std::optional<double> first_exact_crossing(const MovingPolygon& polygon) const;
  std::optional<double> meeting_at_corner(const Volume& volume, double time) const;
  std::optional<Span> only_crossing(const Volume& volume) const;
  Moment moment(double time) const;
  Vec3 corner(int i, double time) const;
  template <int kCount>
  Vec3 direction_of(const Moment& m) const;
  Vec3 direction_to(const Moment& m) const;
  double allowed_reach(const Moment& begin) const;
  void add_between(double from, double to, const Moment& middle);
  bool is_near(const Moment& m) const;
  std::optional<double> first_close_time(const MovingPolygon& polygon, double from, double to);
  bool is_left_out(const Moment& from, const Moment& to) const;
  bool is_left_out_by_new_direction(const Moment& from, const Moment& to) const;
  double separation(const Moment& m, Vec3 direction) const;
  double farthest_separation(const Moment& m) const;
  bool is_as_far(const Moment& m, Vec3 direction, double distance2) const;
  Vec3 best_direction(const Moment& m) const;
  bool is_left_out_by_direction(const Moment& from, const Moment& to) const;
  bool is_left_out_by_volume(const Moment& from, const Moment& to) const;

  int count_ = 0;  // of corners
  Vec3 at_[2][4];  // the corners, scaled
  double scale_ = 1.0;
  double reach_ = 0.0;
  std::vector<Moment> waiting_;  // the next one last
  FinestSpan finest_;
};

}  // namespace tact::narrowphase
