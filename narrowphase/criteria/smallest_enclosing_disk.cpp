#include "narrowphase/criteria/smallest_enclosing_disk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tact::narrowphase {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Coordinates about the middle of the points' box, scaled by a power of two to a size of about 1, so that squares
// neither overflow nor vanish. The difference is rounded relative to itself: far from zero nothing is lost.
struct DiskFrame {
  Point2 origin;
  double scale = 1.0;

  Point2 to_local(Point2 p) const { return {(p.x - origin.x) * scale, (p.y - origin.y) * scale}; }
  Point2 to_world(Point2 p) const { return {origin.x + p.x / scale, origin.y + p.y / scale}; }
};

bool comes_before(Point2 p, Point2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; }
bool same(Point2 p, Point2 q) { return p.x == q.x && p.y == q.y; }
Point2 operator-(Point2 p, Point2 q) { return {p.x - q.x, p.y - q.y}; }
double dot(Point2 p, Point2 q) { return p.x * q.x + p.y * q.y; }
double distance_squared(Point2 p, Point2 q) { return dot(p - q, p - q); }

// The points that decide a disk: up to three, and a fourth during a step. Each stands once, in lexicographic order.
struct Basis {
  std::array<Point2, 4> points{};
  std::size_t count = 0;

  void insert(Point2 p) {
    std::size_t i = 0;
    while (i < count && comes_before(points[i], p)) ++i;
    if (i < count && same(points[i], p)) return;
    for (std::size_t k = count; k > i; --k) points[k] = points[k - 1];
    points[i] = p;
    ++count;
  }
};

struct BasisDisk {
  Point2 center;
  double radius_squared = std::numeric_limits<double>::infinity();  // holds the points that it was made from
  Basis basis;                                                      // those of them that decide it
};

// Takes the disk about `center` if it holds `all` with a smaller radius than `best`.
void keep_smaller(BasisDisk& best, Point2 center, const Basis& all, std::initializer_list<Point2> deciding) {
  double radius_squared = 0.0;
  for (std::size_t i = 0; i < all.count; ++i) {
    radius_squared = std::max(radius_squared, distance_squared(center, all.points[i]));
  }
  if (!(radius_squared < best.radius_squared)) return;
  best.center = center;
  best.radius_squared = radius_squared;
  best.basis.count = 0;
  for (const Point2 p : deciding) best.basis.insert(p);
}

// The circumcircle of p, q, r, if their triangle is acute. Any other circumcircle is larger than a disk around two of
// the points; then the basis would not decide its own disk, and the steps could go round in circles.
void keep_smaller_circumcircle(BasisDisk& best, Point2 p, Point2 q, Point2 r, const Basis& all) {
  // Seen from the corner opposite the longest side: the largest angle is there, and the two sides that meet there
  // include the shortest, which keeps the rounding relative to it.
  const double pq = distance_squared(p, q);
  const double qr = distance_squared(q, r);
  const double rp = distance_squared(r, p);
  if (rp >= pq && rp >= qr)
    std::swap(p, q);
  else if (pq >= qr && pq >= rp)
    std::swap(p, r);
  const Point2 s = q - p;
  const Point2 t = r - p;
  const double twice_area = s.x * t.y - s.y * t.x;
  if (!(dot(s, t) > 0.0) || twice_area == 0.0) return;
  const double ss = dot(s, s);
  const double tt = dot(t, t);
  const Point2 center{p.x + (ss * t.y - tt * s.y) / (2.0 * twice_area),
                      p.y + (tt * s.x - ss * t.x) / (2.0 * twice_area)};
  keep_smaller(best, center, all, {p, q, r});
}

// The smallest disk around up to four points, by trying all pairs and triples.
BasisDisk disk_of_few(const Basis& all) {
  BasisDisk best;
  const auto& p = all.points;
  if (all.count == 1) keep_smaller(best, p[0], all, {p[0]});
  for (std::size_t i = 0; i < all.count; ++i) {
    for (std::size_t j = i + 1; j < all.count; ++j) {
      keep_smaller(best, {0.5 * (p[i].x + p[j].x), 0.5 * (p[i].y + p[j].y)}, all, {p[i], p[j]});
    }
  }
  for (std::size_t skipped = 0; all.count >= 3 && skipped < all.count; ++skipped) {
    if (all.count == 3 && skipped > 0) break;
    std::array<Point2, 3> triple{};
    for (std::size_t i = 0, k = 0; k < 3; ++i) {
      if (all.count == 3 || i != skipped) triple[k++] = p[i];
    }
    keep_smaller_circumcircle(best, triple[0], triple[1], triple[2], all);
  }
  return best;
}

struct Farthest {
  Point2 point;  // local; of equally far ones, the first in lexicographic order
  double distance_squared = -1.0;
};

Farthest farthest_from(Point2 center, std::span<const Point2> points, const DiskFrame& frame) {
  Farthest best;
  for (const Point2& world : points) {
    const Point2 p = frame.to_local(world);
    const double d = distance_squared(p, center);
    if (d > best.distance_squared || (d == best.distance_squared && comes_before(p, best.point))) best = {p, d};
  }
  return best;
}

struct Box2 {
  Point2 lower;
  Point2 upper;
};

Box2 box_of(std::span<const Point2> points) {
  Box2 box{points[0], points[0]};
  for (const Point2& p : points) {
    box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y)};
    box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y)};
  }
  return box;
}

DiskFrame local_frame(const Box2& box) {
  DiskFrame frame;
  frame.origin = {0.5 * (box.lower.x + box.upper.x), 0.5 * (box.lower.y + box.upper.y)};
  const double extent = std::max(box.upper.x - box.lower.x, box.upper.y - box.lower.y);
  if (extent > 0.0) frame.scale = std::ldexp(1.0, std::min(-std::ilogb(extent), 1000));
  return frame;
}

// The center of the smallest disk, in local coordinates. The radius of a basis bounds the answer from below, the
// distance of the farthest point from its center bounds it from above. The steps end when the bounds meet, or when
// rounding stops them from getting closer.
Point2 best_center(std::span<const Point2> points, const DiskFrame& frame) {
  constexpr int kPatience = 16;  // steps without a better bound; rounding costs one or two
  Basis start;
  start.insert(farthest_from({0.0, 0.0}, points, frame).point);
  start.insert(farthest_from(start.points[0], points, frame).point);
  BasisDisk disk = disk_of_few(start);
  Point2 best = disk.center;
  double upper = std::numeric_limits<double>::infinity();
  double lower = -1.0;
  for (int idle = 0; idle < kPatience; ++idle) {
    const Farthest farthest = farthest_from(disk.center, points, frame);
    if (disk.radius_squared > lower) {
      lower = disk.radius_squared;
      idle = 0;
    }
    if (farthest.distance_squared < upper) {
      upper = farthest.distance_squared;
      best = disk.center;
      idle = 0;
    }
    if (upper <= lower * (1.0 + 4.0 * kEpsilon)) break;
    disk.basis.insert(farthest.point);
    disk = disk_of_few(disk.basis);
  }
  return best;
}

}  // namespace

Disk smallest_enclosing_disk(std::span<const Point2> points) {
  if (points.empty()) return {};
  DiskFrame frame = local_frame(box_of(points));
  const Point2 center = frame.to_world(best_center(points, frame));
  // The center was rounded to doubles: measure from what it became. Two differences, two squares, a sum and a root err
  // by less than 4 epsilon, and hypot by less than another.
  frame.origin = center;
  const double radius = std::sqrt(farthest_from({0.0, 0.0}, points, frame).distance_squared);
  const double grown = radius * (1.0 + 8.0 * kEpsilon) / frame.scale;
  // Where the radius is subnormal the division rounds too.
  return {center, radius > 0.0 ? std::max(grown, std::nextafter(radius / frame.scale, 1e308)) : 0.0};
}

}  // namespace tact::narrowphase
