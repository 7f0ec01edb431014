#include "narrowphase/motion/meeting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

// Corners are scaled to at most 2 in size. With u = 2^-53, a coordinate of a corner between two times is wrong by at
// most 12 u: 2 u for the difference of two positions, 4 u for the way, 4 u for a part of it, 2 u for the sum. Its
// product with a direction, which is longer than 1 by 3 u at most, is then wrong by 21 u + 11 u, and the direction's
// length adds 12 u to a reach of 4: together less than 48 u.
constexpr double kDotRounding = 0x1p-46;
// The volume, if the sides of the polygon are at most e and f along each axis: these are wrong by 28 u, their cross
// product by 56 u (e + f) + 4 u ef, its product with a corner by 340 u (e + f) + 130 u ef, and a reach of 4 times its
// length by 390 u (e + f) + 60 u ef: together less than 2^-43 (e + f + ef).
constexpr double kVolumeRounding = 0x1p-43;
constexpr double kNotAsFar = 0x1p-30;  // of the squared distance, beside roundings of 2^-50
constexpr int kMostCloserLooks = 3;    // before a span is as short as it gets: they take some 10 microseconds
constexpr double kLargestReach = 4.0;  // no corner is farther away
// Spans that are looked at. A meeting takes about ten. Only polygons that turn while they stay within 1e-8 of their
// size come near so many; the span at which the search ends then counts as a meeting.
constexpr std::int64_t kMostSpans = 1 << 15;
// How far from a root of the volume its sign is looked at: as near as most polygons allow, or still less than is
// promised.
constexpr double kCrossing = 0x1p-36, kWideCrossing = 0x1p-23;
constexpr double kShortInPlane = 0x1p-20;  // twice the margin in meeting_in_plane(), and some
constexpr int kMostNewtonSteps = 12;
constexpr double kShortestWay = 0x1p-900;  // of a corner: scaled lengths below the smallest double do not matter
// Each halving of the step adds two at most.
constexpr std::size_t kMostMoments = 96;

// Perpendicular to `side`: rounding has left a part along it, which counts where the distance is small.
Vec3 perpendicular(Vec3 direction, Vec3 side) {
  direction = direction - dot(direction, side) / norm_squared(side) * side;
  return norm_squared(direction) > 0.0 ? normalized(direction) : Vec3{};
}

// The coefficients of a cubic before a time, and after it; the one at the time is in both.
std::array<double, 7> halves_at(const std::array<double, 4>& c, double t) {
  const auto mix = [&](double x, double y) { return x + t * (y - x); };
  const double a = mix(c[0], c[1]), b = mix(c[1], c[2]), d = mix(c[2], c[3]), ab = mix(a, b), bd = mix(b, d);
  return {c[0], a, ab, mix(ab, bd), bd, d, c[3]};
}

MovingPolygon scaled(MovingPolygon polygon, double by) {
  for (auto& corners : polygon.corner) {
    for (int i = 0; i < polygon.count; ++i) corners[i] = narrowphase::scaled(corners[i], by);
  }
  return polygon;
}

Vec3 unit(Vec3 v) { return largest_coordinate(v) > 0x1p-500 ? normalized(v) : Vec3{}; }

}  // namespace

MeetingSearch::MeetingSearch() { waiting_.reserve(kMostMoments); }

// Copies the corners, scaled. Lengths so short that no double scales them to near 1 are to be given times the result.
double MeetingSearch::take(const MovingPolygon& polygon) {
  count_ = polygon.count;
  double largest = 0.0;
  for (const auto& corners : polygon.corner) {
    for (int i = 0; i < count_; ++i) largest = std::max(largest, largest_coordinate(heads(corners[i])));
  }
  constexpr double kShort = 0x1p-1000;
  if (largest > 0.0 && largest < kShort) return 1.0 / kShort;
  scale_ = unit_scale(largest);
  for (int time = 0; time < 2; ++time) {
    for (int i = 0; i < count_; ++i) at_[time][i] = scale_ * heads(polygon.corner[time][i]);
  }
  return 1.0;
}

Meeting MeetingSearch::first(const MovingPolygon& polygon, double reach, double latest, double begin) {
  if (const double longer = take(polygon); longer != 1.0)
    return first(scaled(polygon, longer), longer * reach, latest, begin);
  reach_ = std::min(scale_ * reach, kLargestReach);

  Meeting meeting;
  Span span{begin, 1.0};
  if (reach_ == 0.0 && begin == 0.0 && is_decided_at_once(polygon, span, meeting)) return meeting;
  Moment from = moment(span.from);
  if (reach_ > 0.0) reach_ = allowed_reach(from);
  waiting_.assign(1, moment(span.to));
  int closer_looks = reach_ > 0.0 ? 0 : kMostCloserLooks;
  while (!waiting_.empty()) {
    ++meeting.spans;
    const Moment& to = waiting_.back();
    const double length = to.time - from.time;
    const bool is_finest = reach_ > 0.0 && length <= kFinestSpan;
    if (to.covered || is_left_out(from, to) || (is_finest && is_left_out_by_new_direction(from, to))) {
      from = to;
      waiting_.pop_back();
      continue;
    }
    if (from.time > latest) return meeting;
    if (meeting.spans > kMostSpans || is_finest) {
      meeting.time = from.time;
      return meeting;
    }
    const Moment middle = moment(from.time + 0.5 * length);
    if (length > kFinestSpan && (closer_looks <= 0 || !is_near(middle))) {
      add_between(from.time, to.time, middle);
      continue;
    }
    --closer_looks;
    const std::optional<double> close = first_close_time(polygon, from.time, to.time);
    if (!close) {
      from = to;
      waiting_.pop_back();
      continue;
    }
    // What stays open may have no area at that time, and be far away.
    if (length <= kFinestSpan || is_near(moment(*close))) {
      meeting.time = *close;
      return meeting;
    }
    add_between(from.time, to.time, middle);
  }
  return meeting;
}

// Without a search. Otherwise what is outside of `span` is left out.
bool MeetingSearch::is_decided_at_once(const MovingPolygon& polygon, Span& span, Meeting& meeting) {
  const std::optional<double> crossing_of_corner = first_exact_crossing(polygon);
  if (crossing_of_corner == 0.0) {
    meeting.time = 0.0;
    return true;
  }
  if (count_ < 3) return false;
  const Volume volume = volume_on(at_[0], at_[1]);
  if (crossing_of_corner) {
    if (const std::optional<double> begin = meeting_at_corner(volume, *crossing_of_corner)) {
      meeting.time = *begin;
      return true;
    }
  }
  if (const std::optional<Span> crossing = only_crossing(volume)) {
    span = *crossing;
    const Verdict verdict = holds_origin_near(polygon, scale_, span.from, span.to);
    if (verdict == Verdict::yes) meeting.time = span.from;
    return verdict != Verdict::unknown;
  }
  if (!volume.vanishes()) return false;
  const MeetingInPlane flat = meeting_in_plane(polygon, scale_);
  if (flat.verdict == Verdict::yes) meeting.time = flat.from;
  if (flat.verdict != Verdict::unknown) return true;
  span = {flat.from, flat.to};
  if (span.to - span.from > kShortInPlane) return false;
  const std::optional<double> begin = finest_.first_open_part(polygon, scale_, span.from, span.to);
  if (begin && !is_near(moment(*begin))) return false;
  if (begin) meeting.time = *begin;
  return true;
}

// Of layers on equal grids, or of what touches when the step begins, a corner's way goes exactly through the origin:
// two of its coordinates are zero at both times, and the third one changes its sign or is zero. The time is right to a
// few roundings. The differences are exact: where a head is zero, so is its tail.
std::optional<double> MeetingSearch::first_exact_crossing(const MovingPolygon& polygon) const {
  std::optional<double> first;
  for (int i = 0; i < count_; ++i) {
    const Vec3 p = heads(polygon.corner[0][i]), q = heads(polygon.corner[1][i]);
    if (p == Vec3{}) return 0.0;
    int zeros = 0, other = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] == 0.0 && q[axis] == 0.0)
        ++zeros;
      else
        other = axis;
    }
    const bool stays_on_one_side = (p[other] < 0.0 && q[other] < 0.0) || (p[other] > 0.0 && q[other] > 0.0);
    if (zeros < 2 || stays_on_one_side) continue;
    const double begin = at_[0][i][other], way = begin - at_[1][i][other];
    if (!(std::abs(way) > kShortestWay)) continue;
    const double time = begin / way;
    if (!first || time < *first) first = time;
  }
  return first;
}

// The beginning of the meeting, if before the time at which a corner is at the origin nothing meets.
std::optional<double> MeetingSearch::meeting_at_corner(const Volume& volume, double time) const {
  const auto keeps_its_sign_before = [&](double t) {
    const auto before = halves_at(volume.coefficient, t);
    const double sign = before[0] > 0.0 ? 1.0 : -1.0;
    return std::all_of(before.begin(), before.begin() + 4, [&](double x) { return sign * x > volume.rounding; });
  };
  const bool is_flat = volume.vanishes();
  const Moment begin = is_flat ? moment(0.0) : Moment{};
  for (const double margin : {kCrossing, kWideCrossing}) {
    const double from = std::max(time - margin, 0.0);
    if (from == 0.0) return from;
    if (is_flat ? is_left_out_by_direction(begin, moment(from)) : keeps_its_sign_before(from)) return from;
  }
  return std::nullopt;
}

Vec3 MeetingSearch::corner(int i, double time) const { return at_[0][i] + time * (at_[1][i] - at_[0][i]); }

MeetingSearch::Moment MeetingSearch::moment(double time) const {
  Moment m;
  m.time = time;
  for (int i = 0; i < count_; ++i) m.corner[i] = time == 1.0 ? at_[1][i] : corner(i, time);
  m.direction = direction_to(m);
  return m;
}

// A polygon that starts nearer than its reach may come as near as a share of its distance at the start.
double MeetingSearch::allowed_reach(const Moment& begin) const {
  const double above = (1.0 + kJustAbove) * reach_ + kDotRounding;
  if (separation(begin, begin.direction) > above) return reach_;
  const double nearest = farthest_separation(begin);
  return nearest > above ? reach_ : kShareOfGap * std::max(nearest, 0.0);
}

double MeetingSearch::farthest_separation(const Moment& m) const {
  return std::max(separation(m, m.direction), separation(m, best_direction(m)));
}

double MeetingSearch::distance_at_begin(const MovingPolygon& polygon) {
  if (const double longer = take(polygon); longer != 1.0) return distance_at_begin(scaled(polygon, longer)) / longer;
  reach_ = 0.0;
  return std::max(farthest_separation(moment(0.0)) - kDotRounding, 0.0) / scale_;
}

// Goes on between the two next moments: at their middle, or at the ends of the span around the middle that its
// direction leaves out. That approaches a meeting from both sides as fast as Newton's method.
void MeetingSearch::add_between(double from, double to, const Moment& middle) {
  double first = from, last = to;
  for (int i = 0; i < count_; ++i) {
    const double begin = dot(middle.direction, at_[0][i]), way = dot(middle.direction, at_[1][i]) - begin;
    const double crossing = (reach_ + 2.0 * kDotRounding - begin) / way;
    if (way > 0.0) first = std::max(first, crossing);
    if (way < 0.0) last = std::min(last, crossing);
  }
  const auto is_apart_at = [&](double time) {
    for (int i = 0; i < count_; ++i) {
      if (!(dot(middle.direction, corner(i, time)) > reach_ + kDotRounding)) return false;
    }
    return true;
  };
  if (!(first < middle.time && middle.time < last && is_apart_at(first) && is_apart_at(last))) {
    waiting_.push_back(middle);
    return;
  }
  const auto add = [&](double time) -> Moment& {
    Moment& m = waiting_.emplace_back(middle);
    m.time = time;
    for (int i = 0; i < count_; ++i) m.corner[i] = corner(i, time);
    return m;
  };
  (last < to ? add(last) : waiting_.back()).covered = true;
  if (first > from) add(first);
}

// True if the polygon is within the bounds of rounding.
bool MeetingSearch::is_near(const Moment& m) const {
  for (int i = 0; i < count_; ++i) {
    if (dot(m.direction, m.corner[i]) < reach_ + 4.0 * kDotRounding) return true;
  }
  return false;
}

// In double-double.
std::optional<double> MeetingSearch::first_close_time(const MovingPolygon& polygon, double from, double to) {
  if (count_ > 2 && to - from <= kWideCrossing && holds_origin_near(polygon, scale_, from, to) == Verdict::yes)
    return from;
  if (to - from <= kFinestSpan && is_left_out_by_direction(moment(from), moment(to))) return std::nullopt;
  return finest_.first_open_part(polygon, scale_, from, to);
}

bool MeetingSearch::is_left_out(const Moment& from, const Moment& to) const {
  return is_left_out_by_direction(from, to) || is_left_out_by_volume(from, to);
}

// Those that its ends carry are of longer spans, and where a corner passes a corner they leave the middle open however
// far away the polygon is. So short a span is left out by one.
bool MeetingSearch::is_left_out_by_new_direction(const Moment& from, const Moment& to) const {
  const double least = reach_ + kDotRounding;
  const Vec3 direction = best_direction(moment(0.5 * (from.time + to.time)));
  return separation(from, direction) > least && separation(to, direction) > least;
}

double MeetingSearch::separation(const Moment& m, Vec3 direction) const {
  double lowest = dot(direction, m.corner[0]);
  for (int i = 1; i < count_; ++i) lowest = std::min(lowest, dot(direction, m.corner[i]));
  return lowest;
}

// Whether the polygon is as far along a direction as its nearest point is, the square of whose distance is given.
bool MeetingSearch::is_as_far(const Moment& m, Vec3 direction, double distance2) const {
  const double along = separation(m, direction);
  return along > 0.0 && along * along > (1.0 - kNotAsFar) * distance2;
}

// Of those that may lead to the nearest point that along which the polygon is farthest. Where the point is in a corner
// and nearly on a side, rounding chooses between them, and only a direction across the side has all of it beyond.
Vec3 MeetingSearch::best_direction(const Moment& m) const {
  const Vec3* const p = m.corner;
  Vec3 best;
  double farthest = -kLargestReach;
  const auto take = [&](Vec3 direction) {
    const double along = separation(m, direction);
    if (!(along > farthest)) return;
    farthest = along;
    best = direction;
  };
  for (int i = 0; i < count_; ++i) {
    const Vec3 side = p[i + 1 < count_ ? i + 1 : 0] - p[i], to_corner = unit(p[i]);
    take(to_corner);
    const double length2 = norm_squared(side);
    if (!(length2 > 0.0)) continue;
    const double along = std::clamp(-dot(p[i], side) / length2, 0.0, 1.0);
    take(perpendicular(to_corner, side));
    take(perpendicular(unit(p[i] + along * side), side));
  }
  const Vec3 normal = count_ < 3 ? Vec3{} : unit(cross(p[1] - p[0], p[count_ - 1] - p[0]));
  take(normal);
  take(-normal);
  return best;
}

// The direction goes straight from the one to the other, and is nowhere longer than 1.
bool MeetingSearch::is_left_out_by_direction(const Moment& from, const Moment& to) const {
  const double least = reach_ + kDotRounding;
  for (int i = 0; i < count_; ++i) {
    const double mean = 0.5 * (dot(from.direction, to.corner[i]) + dot(to.direction, from.corner[i]));
    if (!(dot(from.direction, from.corner[i]) > least && dot(to.direction, to.corner[i]) > least && mean > least))
      return false;
  }
  return true;
}

bool MeetingSearch::is_left_out_by_volume(const Moment& from, const Moment& to) const {
  if (count_ < 3) return false;
  // Most often an end alone tells that the coefficients do not.
  const auto at_end = [&](const Moment& m) {
    const Vec3 normal = cross(m.corner[1] - m.corner[0], m.corner[count_ - 1] - m.corner[0]);
    const double height = dot(m.corner[0], normal);
    const bool is_open = reach_ > 0.0 && std::abs(height) <= reach_ * std::sqrt(norm_squared(normal));
    return is_open ? 0.0 : height;
  };
  const double last = at_end(to);
  if (last == 0.0 || !(last > 0.0 ? at_end(from) > 0.0 : at_end(from) < 0.0)) return false;
  const Volume volume = volume_on(from.corner, to.corner);
  const auto [low, high] = std::ranges::minmax(volume.coefficient);
  return low > volume.rounding || high < -volume.rounding;
}

bool MeetingSearch::Volume::vanishes() const {
  return std::ranges::all_of(coefficient, [&](double c) { return std::abs(c) <= rounding; });
}

// Its rounding holds what a reach adds.
MeetingSearch::Volume MeetingSearch::volume_on(const Vec3 (&from)[4], const Vec3 (&to)[4]) const {
  const Vec3 e0 = from[1] - from[0], e1 = to[1] - to[0];
  const Vec3 f0 = from[count_ - 1] - from[0], f1 = to[count_ - 1] - to[0];
  const Vec3 n0 = cross(e0, f0), n1 = 0.5 * (cross(e0, f1) + cross(e1, f0)), n2 = cross(e1, f1);
  const Vec3 &d0 = from[0], &d1 = to[0];
  const double e = std::max(largest_coordinate(e0), largest_coordinate(e1)),
               f = std::max(largest_coordinate(f0), largest_coordinate(f1));
  const double area = reach_ > 0.0 ? std::sqrt(std::max({norm_squared(n0), norm_squared(n1), norm_squared(n2)})) : 0.0;
  return {{dot(d0, n0), (dot(d1, n0) + 2.0 * dot(d0, n1)) / 3.0, (2.0 * dot(d1, n1) + dot(d0, n2)) / 3.0, dot(d1, n2)},
          kVolumeRounding * (e + f + e * f) + reach_ * area};
}

// Most often the volume changes its sign once, and is far from zero but for a short span. The root may come from
// anywhere: that nothing meets before and after is proved by coefficients.
std::optional<MeetingSearch::Span> MeetingSearch::only_crossing(const Volume& volume) const {
  const auto& c = volume.coefficient;
  const double sign = c[0] > 0.0 ? 1.0 : -1.0;
  const bool changes_once =
      sign * c[0] > volume.rounding && sign * c[3] < -volume.rounding && !(sign * c[1] < 0.0 && sign * c[2] > 0.0);
  if (!changes_once) return std::nullopt;
  // Newton's method, and halving where that would leave the bracket.
  double low = 0.0, high = 1.0, root = c[0] / (c[0] - c[3]);
  for (int k = 0; k < kMostNewtonSteps; ++k) {
    const auto at = halves_at(c, root);
    (sign * at[3] > 0.0 ? low : high) = root;
    const double next = root - at[3] / (3.0 * (at[4] - at[2]));
    const double last = std::exchange(root, low < next && next < high ? next : 0.5 * (low + high));
    if (std::abs(root - last) < 0.1 * kCrossing) break;
  }
  for (const double margin : {kCrossing, kWideCrossing}) {
    const double from = std::max(root - margin, 0.0), to = std::min(root + margin, 1.0);
    const auto before = halves_at(c, from), after = halves_at(c, to);
    const bool is_apart_before =
        std::all_of(before.begin(), before.begin() + 4, [&](double x) { return sign * x > volume.rounding; });
    const bool is_apart_after =
        std::all_of(after.begin() + 3, after.end(), [&](double x) { return sign * x < -volume.rounding; });
    if (is_apart_before && is_apart_after) return Span{from, to};
  }
  return std::nullopt;
}

// Of so many corners: it is what most of the time goes into.
template <int kCount>
Vec3 MeetingSearch::direction_of(const Moment& m) const {
  const Vec3* const p = m.corner;
  const Vec3 normal = kCount < 3 ? Vec3{} : unit(cross(p[1] - p[0], p[kCount - 1] - p[0]));
  bool inside = normal != Vec3{};
  double least = Meeting::kNever;
  Vec3 nearest_point, nearest_side;
  bool within_side = false;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 from = p[i], side = p[i + 1 < kCount ? i + 1 : 0] - from;
    inside = inside && dot(cross(side, from), normal) <= 0.0;
    const double length2 = norm_squared(side), along = -dot(from, side);
    const bool between = along > 0.0 && along < length2;
    const Vec3 point = between ? from + along / length2 * side : along <= 0.0 ? from : from + side;
    if (norm_squared(point) >= least) continue;
    least = norm_squared(point);
    nearest_point = point;
    nearest_side = side;
    within_side = between;
  }
  const Vec3 nearest = within_side ? perpendicular(unit(nearest_point), nearest_side) : unit(nearest_point);
  // Without a reach double-doubles decide what is so near that this matters.
  if (!inside) return reach_ == 0.0 || is_as_far(m, nearest, least) ? nearest : best_direction(m);
  // For a polygon with next to no area, rounding may say so of any point.
  const Vec3 above = dot(normal, p[0]) < 0.0 ? -normal : normal;
  return separation(m, nearest) > separation(m, above) ? nearest : above;
}

Vec3 MeetingSearch::direction_to(const Moment& m) const {
  switch (count_) {
    case 4: return direction_of<4>(m);
    case 3: return direction_of<3>(m);
    case 2: return direction_of<2>(m);
    default: return direction_of<1>(m);
  }
}

}  // namespace tact::narrowphase
