#include "narrowphase/numeric/double_double.h"

#include <algorithm>

#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {
namespace {

// No square of a number of such a size vanishes or overflows.
bool is_moderate(double largest) { return largest > 0x1p-400 && largest < 0x1p400; }

}  // namespace

double length_of(Vec3 v) {
  const double largest = largest_coordinate(v);
  if (is_moderate(largest)) return base::norm(v);
  const double scale = unit_scale(largest);
  return base::norm(scale * v) / scale;
}

Vec3 unit_vector(Vec3 v) {
  const double largest = largest_coordinate(v);
  if (is_moderate(largest)) return base::normalized(v);  // the same bits
  return base::normalized(unit_scale(largest) * v);
}

Vec3 moderate_cross(Vec3 p, Vec3 q) {
  const Vec3 product = cross(p, q);
  if (is_moderate(largest_coordinate(product))) return product;  // the same bits
  const Vec3 moderate = cross(unit_scale(largest_coordinate(p)) * p, unit_scale(largest_coordinate(q)) * q);
  return unit_scale(largest_coordinate(moderate)) * moderate;
}

}  // namespace tact::narrowphase
