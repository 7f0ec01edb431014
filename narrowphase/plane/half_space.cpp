#include "narrowphase/plane/half_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/rounded.h"
#include "narrowphase/numeric/wide_integer.h"

namespace tact::narrowphase {

namespace {

// As doubles compute a height, its four terms are rounded at most four times each; what vanishes is below the rest.
constexpr double kRoundings = 0x1p-50;
constexpr double kVanishes = 0x1p-1000;
// The same in double-doubles, where what is multiplied does not vanish.
constexpr double kFineRoundings = 0x1p-98;

bool is_moderate(double x) { return x == 0.0 || (std::abs(x) > 0x1p-400 && std::abs(x) < 0x1p400); }
bool is_moderate(Vec3 v) { return is_moderate(v.x) && is_moderate(v.y) && is_moderate(v.z); }

double error_of_size(const HalfSpace& space, Vec3 size) {
  const Vec3 n{std::abs(space.normal.x), std::abs(space.normal.y), std::abs(space.normal.z)};
  return kRoundings * (dot(n, size) + std::abs(space.offset)) + kVanishes;
}

// The exponent of the lowest bit of x * y, as lowest_bit() counts. No number has one as low as this is for zero.
int lowest_bit_of_product(double x, double y) {
  if (x == 0.0 || y == 0.0) return std::numeric_limits<int>::max();
  return lowest_bit(x) + lowest_bit(y) - 1075;
}

int lowest_bit_of_height(const HalfSpace& space, Vec3 p) {
  int lowest = lowest_bit(space.offset);
  for (int axis = 0; axis < 3; ++axis) lowest = std::min(lowest, lowest_bit_of_product(space.normal[axis], p[axis]));
  return lowest;
}

// x * y in units of 2^(unit - 1075), `unit` at most its lowest bit. Products are below 2^301 and above 2^-2149.
WideInteger<42> product_in_units(double x, double y, int unit) {
  if (x == 0.0 || y == 0.0) return {};
  const int of_x = lowest_bit(x), of_y = lowest_bit(y);
  return power_of_two<40>(of_x + of_y - 1075 - unit) * (in_units<1>(x, of_x) * in_units<1>(y, of_y));
}

using WideHeight = WideInteger<45>;

WideHeight height_in_units(const HalfSpace& space, Vec3 p, int unit) {
  const Vec3& n = space.normal;
  return ((product_in_units(n.x, p.x, unit) + product_in_units(n.y, p.y, unit)) + product_in_units(n.z, p.z, unit)) -
         product_in_units(1.0, space.offset, unit);
}

template <int kCapacity>
WideInteger<kCapacity> magnitude(const WideInteger<kCapacity>& x) {
  return x.sign() < 0 ? -x : x;
}

// x * 2^(unit - 1075), rounded once.
template <int kCapacity>
double rounded_number(const WideInteger<kCapacity>& x, int unit) {
  if (x.sign() == 0) return 0.0;
  const WideInteger<kCapacity> size = magnitude(x);
  const int bits = size.bit_count();
  const double near = std::ldexp(size.times_power(bits), bits + unit - 1075);
  const double nearest = rounded(near, [&](double one, double next) {
    const SumOfNeighbors sum(one, next);
    return (power_of_two<52>(std::max(unit - sum.unit, 0) + 1) * size -
            power_of_two<52>(std::max(sum.unit - unit, 0)) * sum.in_units_of_it)
        .sign();
  });
  return x.sign() < 0 ? -nearest : nearest;
}

// a / b for 0 <= a <= b, b > 0, rounded down.
template <int A, int B>
double quotient_rounded_down(const WideInteger<A>& a, const WideInteger<B>& b) {
  const double nearest = rounded_quotient(a, b);
  if (nearest == 0.0) return 0.0;
  const int unit = lowest_bit(nearest);
  const bool is_above =
      (power_of_two<18>(unit) * (in_units<1>(nearest, unit) * b) - power_of_two<18>(1075) * a).sign() > 0;
  return is_above ? std::nextafter(nearest, 0.0) : nearest;
}

}  // namespace

double height_over(const HalfSpace& space, Vec3 p) {
  const Vec3& n = space.normal;
  if (is_moderate(n) && is_moderate(p) && is_moderate(space.offset)) {
    const DoubleDouble products[3] = {two_product(n.x, p.x), two_product(n.y, p.y), two_product(n.z, p.z)};
    const DoubleDouble height = ((products[0] + products[1]) + products[2]) - DoubleDouble{space.offset};
    const double size =
        std::abs(products[0].head) + std::abs(products[1].head) + std::abs(products[2].head) + std::abs(space.offset);
    if (rounds_to_head(height, kFineRoundings * size)) return height.head + 0.0;
  }
  const int unit = lowest_bit_of_height(space, p);
  return unit == std::numeric_limits<int>::max() ? 0.0 : rounded_number(height_in_units(space, p, unit), unit);
}

bool goes_down(const HalfSpace& space, Vec3 from, Vec3 to) {
  const double first = height_over(space, from), last = height_over(space, to);
  if (first != last) return last < first;
  const int unit = std::min(lowest_bit_of_height(space, from), lowest_bit_of_height(space, to));
  return unit != std::numeric_limits<int>::max() &&
         (height_in_units(space, to, unit) - height_in_units(space, from, unit)).sign() < 0;
}

double height_error(const HalfSpace& space, const Box& box) { return error_of_size(space, farthest_from({}, box)); }

Vec3 lowest_corner(const HalfSpace& space, const Box& box) {
  Vec3 corner;
  for (int axis = 0; axis < 3; ++axis) corner[axis] = space.normal[axis] >= 0.0 ? box.lower[axis] : box.upper[axis];
  return corner;
}

bool reaches(const HalfSpace& space, const Box& box, double reach) {
  if (box.empty()) return false;
  const double roundings = height_error(space, box) + kRoundings * reach;
  return rough_height_over(space, lowest_corner(space, box)) <= reach + roundings;
}

std::optional<double> meeting_place(const HalfSpace& space, Vec3 from, Vec3 to) {
  const double at_from = height_over(space, from), at_to = height_over(space, to);
  if (at_from == 0.0) return 0.0;
  if ((at_from > 0.0) == (at_to > 0.0) && at_to != 0.0) return {};
  if (at_to == 0.0) return 1.0;
  const int unit = std::min(lowest_bit_of_height(space, from), lowest_bit_of_height(space, to));
  const auto first = magnitude(height_in_units(space, from, unit)), last = magnitude(height_in_units(space, to, unit));
  return rounded_quotient(first, first + last);
}

std::optional<double> meeting_time(const HalfSpace& space, Vec3 from, Vec3 to, double reach) {
  const double error = height_error(space, extended(extended(Box{}, from), to)) + kRoundings * reach;
  const double rough_from = rough_height_over(space, from), rough_to = rough_height_over(space, to);
  if (std::min(rough_from, rough_to) > reach + error || std::max(rough_from, rough_to) < -reach - error) return {};
  const int unit = std::min({lowest_bit_of_height(space, from), lowest_bit_of_height(space, to), lowest_bit(reach)});
  if (unit == std::numeric_limits<int>::max()) return 0.0;
  const WideHeight at_from = height_in_units(space, from, unit), at_to = height_in_units(space, to, unit);
  const auto of_reach = product_in_units(1.0, reach, unit);
  const auto before = magnitude(at_from) - of_reach;  // how much it has to come down
  if (before.sign() <= 0) return 0.0;
  const auto way = at_from.sign() > 0 ? at_from - at_to : at_to - at_from;
  if ((way - before).sign() < 0) return {};
  return quotient_rounded_down(before, way);
}

}  // namespace tact::narrowphase
