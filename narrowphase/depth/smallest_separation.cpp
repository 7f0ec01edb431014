#include "narrowphase/depth/smallest_separation.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/frame.h"

namespace tact::narrowphase {
namespace {

// A surface that has grown, from step to step, by more than twice the faces of a fresh one and so many more costs more
// than it saves.
constexpr int kFacesToSpare = 32;
// If the direction found is turned by more than this (a cosine) from the preferred one, a nearer one is looked for.
constexpr double kTurned = 0.9;

class SurfaceExpansion {
 public:
  SurfaceExpansion(const MinkowskiDifference& m, const SmallestStart& start, SmallestMemory& memory)
      : m_(m),
        start_(start),
        preferred_(preferred_direction(start.preferred)),
        tolerance_(height_tolerance(m)),
        limit_(query_limit(m)),
        surface_(memory.surface),
        open_(memory.open),
        queried_(memory.queried) {
    queried_.restart();
  }

  // Nothing if plain doubles do not suffice.
  std::optional<SmallestSeparation> run() {
    if (!(continues() && expand()) && !(begins() && expand())) return std::nullopt;
    QueriedDirections::Queried best = choose();
    if (dot(best.direction, preferred_) < kTurned) best = query_nearer(best);
    save();
    return SmallestSeparation{.direction = best.direction,
                              .height = best.height,
                              .lower_bound = std::min(lower_bound_ - 2.0 * m_.height_error(), best.height),
                              .face = face_across(best.direction),
                              .support_queries = queried_.count(),
                              .limit_reached = false};
  }

 private:
  QueriedDirections::Queried choose() const { return queried_.choose(preferred_, m_.height_error()); }

  bool continues() {
    if (start_.shape == nullptr || start_.shape->face_count == 0) return false;
    fresh_face_count_ = start_.shape->fresh_face_count;
    continued_ = start_.is_placed || surface_.start(m_, *start_.shape);
    return continued_;
  }

  bool begins() {
    continued_ = false;
    fresh_face_count_ = 0;
    queried_.query(m_, preferred_);
    const GjkSimplex& s = start_.hulls;
    std::array<MinkowskiVertex, 4> v;
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.count); ++i) v[i] = m_.vertex(s.a[i], s.b[i]);
    switch (s.count) {
      case 4: return surface_.start(m_, tetrahedron_shape(v));
      case 3: return surround_triangle({v[0], v[1], v[2]});
      case 2: return surround_segment(v[0], v[1]);
      default: return false;
    }
  }

  // The origin lies in the triangle, but for rounding.
  bool surround_triangle(const std::array<MinkowskiVertex, 3>& ring) {
    const Vec3 p = ring[0].point;
    const Vec3 n =
        double_double_cross(double_double_difference(ring[1].point, p), double_double_difference(ring[2].point, p));
    if (n == Vec3{}) return false;
    const Vec3 up = unit_vector(n);
    const MinkowskiVertex top = queried_.query(m_, up);
    return surface_.start(m_, bipyramid_shape(ring, top, queried_.query(m_, -up)));
  }

  // The origin lies on the segment, but for rounding.
  bool surround_segment(const MinkowskiVertex& top, const MinkowskiVertex& bottom) {
    const Vec3 along = top.point - bottom.point;
    if (along == Vec3{}) return false;
    const Frame frame = frame_across(unit_vector(along));
    std::array<MinkowskiVertex, 3> ring;
    for (std::size_t i = 0; i < 3; ++i) ring[i] = queried_.query(m_, kThirds[i].x * frame.u + kThirds[i].y * frame.v);
    return surface_.start(m_, bipyramid_shape(ring, top, bottom));
  }

  // Expands the surface over its nearest face until that is a face of M, or as good.
  bool expand() {
    open_.clear();
    if (!query(nearest_of_all())) return false;
    open_faces(0);
    while (!open_.empty()) {
      const int nearest = take_nearest();
      if (nearest < 0) continue;
      lower_bound_ = surface_.faces()[nearest].distance;
      if (closed()) return true;
      if (nearest != queried_face_ && !query(nearest)) return false;
      if (closed()) return true;
      const int first = surface_.expand(nearest, top_);
      if (first < 0) return false;
      open_faces(first);
    }
    lower_bound_ = queried_.least();
    return true;
  }

  // Queries the vertex of M that is farthest across a face. False if the limit of queries is reached.
  bool query(int face) {
    if (queried_.count() >= limit_) return false;
    surface_.sharpen(face);
    queried_face_ = face;
    top_ = queried_.query(m_, surface_.faces()[face].normal);
    return true;
  }

  int nearest_of_all() const {
    const auto least = [](const StarSurface::Face& f, const StarSurface::Face& g) { return f.distance < g.distance; };
    const auto nearest = std::min_element(surface_.faces().begin(), surface_.faces().end(), least);
    return static_cast<int>(nearest - surface_.faces().begin());
  }

  // All equally low faces are on the surface, as a ball of that radius about the origin is inside of it. Queries those
  // that are nearer to the preferred direction than the one that was found, the nearest first.
  QueriedDirections::Queried query_nearer(const QueriedDirections::Queried& found) {
    double most = 2.0;
    while (true) {
      const int f = nearest_to_preferred(dot(found.direction, preferred_), most);
      if (f < 0) return found;
      surface_.sharpen(f);
      const Vec3 n = surface_.faces()[f].normal;
      most = dot(n, preferred_);
      queried_.query(m_, n);
      const QueriedDirections::Queried best = choose();
      if (best.direction != n) continue;
      queried_face_ = f;
      return best;
    }
  }

  // Of the faces that may be as low as the lowest, the one nearest to the preferred direction: by a cosine above
  // `least` and below `most`.
  int nearest_to_preferred(double least, double most) const {
    int nearest = -1;
    for (int f = 0; f < static_cast<int>(surface_.faces().size()); ++f) {
      const StarSurface::Face& face = surface_.faces()[f];
      if (face.removed || face.distance - face.error > queried_.least() + m_.height_error()) continue;
      const double cosine = dot(face.normal, preferred_);
      if (!(cosine > least && cosine < most)) continue;
      least = cosine;
      nearest = f;
    }
    return nearest;
  }

  bool closed() const { return queried_.least() - lower_bound_ <= tolerance_; }

  // Takes the face that may be the nearest off the heap. It is returned with its plane sharp; or it goes back with the
  // sharp plane, if that is farther than another's, and -1 is returned.
  int take_nearest() {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const int f = open_.back().face;
    open_.pop_back();
    const StarSurface::Face& face = surface_.faces()[f];
    if (face.removed) return -1;
    if (!face.sharp && surface_.sharpen(f) && !open_.empty() && face.distance > open_.front().distance) {
      open(f, face.distance);
      return -1;
    }
    return f;
  }

  void open(int face, double distance) {
    open_.push_back({distance, face});
    std::push_heap(open_.begin(), open_.end(), std::greater<>());
  }

  // A face whose plane is as far as the least height is never the nearest, nor does it have to be expanded.
  void open_faces(int first) {
    for (int f = first; f < static_cast<int>(surface_.faces().size()); ++f) {
      const StarSurface::Face& face = surface_.faces()[f];
      const double least = face.sharp ? face.distance : face.distance - face.error;
      if (least < queried_.least()) open(f, least);
    }
  }

  // The vertices of the last face, if that lies across the direction: most likely a face of M.
  GjkSimplex face_across(Vec3 direction) const {
    GjkSimplex simplex;
    if (queried_face_ < 0 || dot(surface_.faces()[queried_face_].normal, direction) < kAcross) return simplex;
    for (int k = 0; k < 3; ++k) {
      simplex.a[k] = surface_.corner(queried_face_, k).a;
      simplex.b[k] = surface_.corner(queried_face_, k).b;
    }
    simplex.count = 3;
    return simplex;
  }

  void save() {
    if (start_.shape == nullptr) return;
    if (continued_ && surface_.face_count() == static_cast<int>(surface_.faces().size())) return;  // as it was
    surface_.save(*start_.shape);
    if (fresh_face_count_ == 0) fresh_face_count_ = start_.shape->face_count;
    start_.shape->fresh_face_count = fresh_face_count_;
    if (start_.shape->face_count > 2 * fresh_face_count_ + kFacesToSpare) start_.shape->face_count = 0;
  }

  static constexpr double kAcross = 1.0 - 1e-9;

  const MinkowskiDifference& m_;
  const SmallestStart& start_;
  Vec3 preferred_;
  double tolerance_;
  int limit_;
  StarSurface& surface_;
  std::vector<OpenFace>& open_;  // a heap, the nearest on top; removed faces stay in it
  QueriedDirections& queried_;
  double lower_bound_ = 0.0;
  int queried_face_ = -1;  // the last face whose farthest vertex was queried
  MinkowskiVertex top_;    // that vertex
  bool continued_ = false;
  int fresh_face_count_ = 0;
};

}  // namespace

SmallestSeparation smallest_separation(const MinkowskiDifference& m, const SmallestStart& start,
                                       SmallestMemory& memory) {
  SurfaceExpansion search(m, start, memory);
  if (const auto found = search.run()) return *found;
  if (start.shape != nullptr) start.shape->face_count = 0;
  SmallestSeparation exact = expanding_polytope(m, start.preferred, memory.polytope);
  exact.support_queries += memory.queried.count();
  return exact;
}

}  // namespace tact::narrowphase
