// Integers of 128 bits: whoever multiplies knows that nothing overflows.
#pragma once

#include "narrowphase/numeric/wide_integer.h"

namespace tact::narrowphase {

struct SmallInteger {
  Int128 value = 0;

  int sign() const { return (value > 0) - (value < 0); }
  SmallInteger operator-() const { return {-value}; }
  friend SmallInteger operator+(SmallInteger a, SmallInteger b) { return {a.value + b.value}; }
  friend SmallInteger operator-(SmallInteger a, SmallInteger b) { return {a.value - b.value}; }
  friend SmallInteger operator*(SmallInteger a, SmallInteger b) { return {a.value * b.value}; }
};

}  // namespace tact::narrowphase
