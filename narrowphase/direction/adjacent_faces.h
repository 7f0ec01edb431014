// Finds a lower face of M among those next to the one that a direction supports. With this the search for a contact
// direction leaves an edge or a corner, or a face near whose border the projection of the origin lies.
#pragma once

#include <optional>

#include "narrowphase/direction/minkowski_face.h"

namespace tact::narrowphase {

// The face, edge or corner of M that n supports.
struct SupportedFace {
  Vec3 n;
  double height;        // w(n)
  MinkowskiVertex top;  // a vertex of it
  const FacePolygon* polygon;
};

class AdjacentFaces {
 public:
  // Heights that differ by no more than `tolerance` (scaled) are equal. `faces` lends its memory.
  AdjacentFaces(const MinkowskiDifference& m, FaceFinder& faces, double tolerance)
      : m_(m), faces_(faces), tolerance_(tolerance) {}

  // The normal of the lowest face next to `face`, or nothing if none is lower. Looks across each side that the
  // projection lies beyond or nearer to than `near`; both ways from an edge; and around each corner between two such
  // sides, or at an end of one across which the next face is hardly turned. Afterwards the polygon is invalid.
  std::optional<Vec3> lowest(const SupportedFace& face, double near);

  int support_queries() const { return support_queries_; }
  // True if lowest() found nothing and left corners out.
  bool limit_reached() const { return limit_reached_; }

 private:
  enum class Way { counter_clockwise, clockwise };

  bool turn_over_side(const SupportedFace& face, std::size_t side);
  void go_around(const SupportedFace& face, Vec3 corner);
  bool go_around(const SupportedFace& face, Vec3 corner, Way way);
  double try_direction(Vec3 n, const MinkowskiVertex& near);

  const MinkowskiDifference& m_;
  FaceFinder& faces_;
  double tolerance_;
  double near_ = 0.0;
  double lowest_height_ = 0.0;
  std::optional<Vec3> lowest_;
  int support_queries_ = 0;
  bool limit_reached_ = false;
};

}  // namespace tact::narrowphase
