// Double-doubles with a bound of their error: they know where their sign is certain.
#pragma once

#include <cmath>

#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

// Of numbers up to 2^100 in size.
class BoundedNumber {
 public:
  BoundedNumber() = default;
  // Without an error.
  explicit BoundedNumber(DoubleDouble value) : value_(value) {}

  double rounded() const { return value_.head; }
  // Twice the bound, for the roundings of the bound itself and for the tail.
  double error() const { return 2.0 * error_; }
  // 0 where it is not certain: then unclear() is set. What is made from zeros, or from equal numbers, is zero.
  int sign() const {
    if (std::abs(value_.head) > error()) return value_.head > 0.0 ? 1 : -1;
    if (!is_zero()) unclear() = true;
    return 0;
  }
  // Of this thread: true if any sign was uncertain since this was reset.
  static bool& unclear() {
    static thread_local constinit bool value = false;
    return value;
  }

  // One that is certain is enough.
  friend bool all_zero(const BoundedNumber& x, const BoundedNumber& y, const BoundedNumber& z) {
    for (const BoundedNumber* number : {&x, &y, &z}) {
      if (std::abs(number->value_.head) > number->error()) return false;
    }
    return x.sign() == 0 && y.sign() == 0 && z.sign() == 0;
  }

  friend bool operator==(const BoundedNumber&, const BoundedNumber&) = default;
  BoundedNumber operator-() const { return {-value_, error_}; }
  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.error_ + b.error_ == 0.0 && a.value_.head == -b.value_.head && a.value_.tail == -b.value_.tail) return {};
    return {a.value_ + b.value_, a.error_ + b.error_ + kSumError * (a.size() + b.size())};
  }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) { return a + -b; }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.is_zero() || b.is_zero()) return {};
    return {a.value_ * b.value_, a.size() * b.error_ + b.size() * a.error_ + a.error_ * b.error_ +
                                     kProductError * (a.size() * b.size()) + kVanished};
  }

 private:
  // Twice what double_double.h says; and what may vanish of a product.
  static constexpr double kSumError = 0x1p-103, kProductError = 0x1p-101, kVanished = 0x1p-1000;

  BoundedNumber(DoubleDouble value, double error) : value_(value), error_(error) {}
  bool is_zero() const { return value_.head == 0.0 && error_ == 0.0; }
  double size() const { return std::abs(value_.head); }

  DoubleDouble value_;
  double error_ = 0.0;
};

}  // namespace tact::narrowphase
