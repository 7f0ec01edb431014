// A half-space: how high points stand over its plane, and when what moves straight passes it. Decided exactly, and
// rounded once.
#pragma once

#include <optional>

#include "engine/base/box.h"

namespace tact::narrowphase {

using base::Box;
using base::Vec3;

/// All x with normal · x <= offset. The normal is of length 1 but for 1e-9 and is taken as it is; coordinates and the
/// offset are at most 2^300 in size.
struct HalfSpace {
  Vec3 normal;
  double offset = 0.0;  // metres
  friend bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// normal · p - offset, rounded once. Its sign is exact.
double height_over(const HalfSpace& space, Vec3 p);
/// Whether `to` is lower over the plane than `from`. Exact.
bool goes_down(const HalfSpace& space, Vec3 from, Vec3 to);
/// The height as doubles compute it, and by how much that may be wrong of any point of a box.
inline double rough_height_over(const HalfSpace& space, Vec3 p) { return dot(space.normal, p) - space.offset; }
double height_error(const HalfSpace& space, const Box& box);
/// The corner of a box that stands lowest over the plane.
Vec3 lowest_corner(const HalfSpace& space, const Box& box);

/// Whether a box reaches down to `reach` over the plane; where doubles cannot tell, it does. An empty one does not.
bool reaches(const HalfSpace& space, const Box& box, double reach);

/// The part of the way from one point to another, both at most 2^300, at which it first is in the plane: the exact one,
/// rounded once. None if it is nowhere.
std::optional<double> meeting_place(const HalfSpace& space, Vec3 from, Vec3 to);
/// The same of the time from 0 to 1 at which it first comes as near to the plane as `reach`, rounded down.
std::optional<double> meeting_time(const HalfSpace& space, Vec3 from, Vec3 to, double reach);

}  // namespace tact::narrowphase
