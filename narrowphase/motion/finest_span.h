// The last part of the search for a meeting (meeting.h): spans of time in which doubles cannot tell.
#pragma once

#include <optional>
#include <vector>

#include "narrowphase/motion/moving_polygon.h"

namespace tact::narrowphase {

// Of the step. Two corners that move apart by their size and way move by 1e-12 of it in that time.
inline constexpr double kFinestSpan = 0x1p-42;

/// One for each thread, its memory used again.
class FinestSpan {
 public:
  FinestSpan();
  ~FinestSpan();

  /// Of a polygon, scaled to coordinates of at most 2, that comes next to the origin between `from` and `to`: the
  /// beginning of the first part of that span in which it may hold the origin, or nothing if it certainly never does.
  ///
  /// At the time when the origin is in its plane, it has to be on the inner side of all sides. The volume that tells
  /// the one, and a product of the normal and each side that tells the other, are polynomials in time; double_doubles
  /// find their Bernstein coefficients on the span, which is halved until their signs say yes or no. Of a
  /// point or a segment that passes the origin, coordinates and cross products tell. Parts in which the polygon has no
  /// area, and what is nearer than 1e-25, stay open.
  std::optional<double> first_open_part(const MovingPolygon& polygon, double scale, double from, double to);

 private:
  struct Part;
  struct ThinPart;
  std::vector<Part> parts_;  // the next one last
  std::vector<ThinPart> thin_parts_;
};

/// Does it hold the origin at some time between a little before `from` and a little after `to`? In doubles, which
/// cannot always tell.
enum class Verdict { no, yes, unknown };
Verdict holds_origin_near(const MovingPolygon& polygon, double scale, double from, double to);

}  // namespace tact::narrowphase
