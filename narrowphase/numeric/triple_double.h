// Numbers as sums of three doubles: for places on simplices so thin that double-doubles lose them, too.
#pragma once

#include <cstddef>

#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

// The sum of its parts, each at most a rounding of the one before. Sums and differences are right to 2^-150 of their
// operands, products and quotients to 2^-150 of themselves; what is multiplied must be zero or between 2^-250 and 2^250
// in size, and so must the product.
struct TripleDouble {
  double head = 0.0, middle = 0.0, tail = 0.0;

  TripleDouble() = default;
  TripleDouble(double value) : head(value) {}  // NOLINT: a double is one, without rounding

  // The sum of some doubles that grow from the first to the last. Each pass leaves the rounded sum in the last place,
  // and what rounding took from it in those before: two passes, or three where the largest may cancel.
  template <int kPasses, std::size_t kCount>
  static TripleDouble sum_of(double (&part)[kCount]) {
    for (int pass = 0; pass < kPasses; ++pass) {
      for (std::size_t i = 1; i < kCount; ++i) {
        const DoubleDouble sum = two_sum(part[i], part[i - 1]);
        part[i] = sum.head;
        part[i - 1] = sum.tail;
      }
    }
    TripleDouble sum(part[kCount - 1]);
    sum.middle = part[kCount - 2];
    sum.tail = part[kCount - 3];
    return sum;
  }

  explicit operator double() const { return head; }
  TripleDouble operator-() const {
    TripleDouble negated(-head);
    negated.middle = -middle;
    negated.tail = -tail;
    return negated;
  }
  friend TripleDouble operator+(const TripleDouble& a, const TripleDouble& b) {
    double part[] = {b.tail, a.tail, b.middle, a.middle, b.head, a.head};
    return sum_of<3>(part);
  }
  friend TripleDouble operator-(const TripleDouble& a, const TripleDouble& b) { return a + -b; }
  friend TripleDouble operator*(const TripleDouble& a, const TripleDouble& b) {
    const DoubleDouble heads = two_product(a.head, b.head);
    const DoubleDouble first = two_product(a.head, b.middle), second = two_product(a.middle, b.head);
    const double least = first.tail + second.tail + (a.head * b.tail + a.middle * b.middle + a.tail * b.head);
    double part[] = {least, heads.tail, first.head, second.head, heads.head};
    return sum_of<2>(part);
  }
  // Digit by digit.
  friend TripleDouble operator/(TripleDouble a, const TripleDouble& b) {
    double part[4] = {};
    for (std::size_t i = 4; i-- > 0;) {
      part[i] = a.head / b.head;
      a = a - part[i] * b;
    }
    return sum_of<2>(part);
  }
  friend bool operator<(const TripleDouble& a, const TripleDouble& b) { return (a - b).head < 0.0; }
  friend bool operator>(const TripleDouble& a, const TripleDouble& b) { return b < a; }
};

}  // namespace tact::narrowphase
