// The last part of the search for a meeting (meeting.h): spans of time in which doubles cannot tell.
#pragma once

#include <optional>
#include <vector>

#include "narrowphase/motion/moving_polygon.h"

namespace tact::narrowphase {

// Of the step. Two corners that move apart by their size and way move by 1e-12 of it in that time.
inline constexpr double kFinestSpan = 0x1p-42;

/// One for each thread; its memory is reused.
class FinestSpan {
 public:
  FinestSpan();
  ~FinestSpan();

  /// A polygon, scaled to coordinates of at most 2, comes next to the origin between `from` and `to`. Returns the
  /// beginning of the first part of that span in which it may hold the origin, or nothing if it certainly never does.
  ///
  /// The polygon holds the origin when the origin is in its plane and on the inner side of all sides. A volume tells
  /// the first, a product of the normal and each side the second. Both are polynomials in time; their Bernstein
  /// coefficients on the span are computed in double-double, and the span is halved until the signs say yes or no. For
  /// a point or a segment, coordinates and cross products tell. Parts in which the polygon has no area, or is nearer
  /// than 1e-25, stay open.
  std::optional<double> first_open_part(const MovingPolygon& polygon, double scale, double from, double to);

 private:
  struct Part;
  struct ThinPart;
  std::vector<Part> parts_;  // the next one last
  std::vector<ThinPart> thin_parts_;
};

/// Whether it holds the origin at some time between a little before `from` and a little after `to`. In doubles, which
/// cannot always tell.
enum class Verdict { no, yes, unknown };
Verdict holds_origin_near(const MovingPolygon& polygon, double scale, double from, double to);

/// For a polygon whose plane goes through the origin all the time, as that of two edges that stay in one plane: whether
/// it holds the origin, and since when. The sides alone decide. Newton's method finds when one turns to the origin
/// last, and when one turns away first; coefficients prove that the origin is beyond them before and after.
struct MeetingInPlane {
  Verdict verdict = Verdict::unknown;
  double from = 0.0;  // it does not hold the origin before this; yes: it does since then, or up to 2^-35 later
  double to = 1.0;    // unknown: if it ever holds the origin, it does so first between these
};
MeetingInPlane meeting_in_plane(const MovingPolygon& polygon, double scale);

}  // namespace tact::narrowphase
