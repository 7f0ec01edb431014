// Integers of a fixed number of limbs: exact sums, differences and products without a heap. Only the limbs in use are
// touched, so small values are cheap however large the capacity.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace tact::narrowphase {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

// Sign and magnitude, limbs of 64 bits, the least significant one first. Results have the capacity that holds any
// result of their operands, so nothing can overflow.
template <int kCapacity>
class WideInteger {
 public:
  // Zero.
  WideInteger() = default;

  // mantissa * 2^shift, negated if `negative`. The value must have at most 64 * kCapacity bits.
  WideInteger(bool negative, std::uint64_t mantissa, int shift) {
    if (mantissa == 0) return;
    const int limb = shift / 64;
    const UInt128 shifted = static_cast<UInt128>(mantissa) << (shift % 64);
    std::fill(limbs_, limbs_ + limb, std::uint64_t{0});
    negative_ = negative;
    size_ = limb;
    push(static_cast<std::uint64_t>(shifted));
    push(static_cast<std::uint64_t>(shifted >> 64));
    trim();
  }

  // The same number with room for larger ones.
  template <int B>
  requires(B < kCapacity) WideInteger(const WideInteger<B>& b) : size_(b.size_), negative_(b.negative_) {
    std::copy(b.limbs_, b.limbs_ + b.size_, limbs_);
  }

  // Only limbs in use are copied.
  WideInteger(const WideInteger& b) : size_(b.size_), negative_(b.negative_) {
    std::copy(b.limbs_, b.limbs_ + b.size_, limbs_);
  }
  WideInteger& operator=(const WideInteger& b) {
    if (this == &b) return *this;
    size_ = b.size_;
    negative_ = b.negative_;
    std::copy(b.limbs_, b.limbs_ + b.size_, limbs_);
    return *this;
  }

  // -1, 0 or 1.
  int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

  // Of the magnitude; 0 for zero.
  int bit_count() const { return size_ == 0 ? 0 : 64 * size_ - std::countl_zero(limbs_[size_ - 1]); }

  // The number times 2^-shift, with a relative error of at most 2^-52 unless that vanishes in a double.
  double times_power(int shift) const {
    if (size_ == 0) return 0.0;
    const UInt128 below = size_ > 1 ? limbs_[size_ - 2] : 0;
    const auto top = static_cast<double>(static_cast<UInt128>(limbs_[size_ - 1]) << 64 | below);
    return std::ldexp(negative_ ? -top : top, 64 * (size_ - 2) - shift);
  }

  WideInteger operator-() const {
    WideInteger negated = *this;
    negated.negative_ = !negative_;
    return negated;
  }

  template <int B>
  WideInteger<std::max(kCapacity, B) + 1> operator+(const WideInteger<B>& b) const {
    WideInteger<std::max(kCapacity, B) + 1> sum;
    sum.set_sum(*this, b, b.negative_);
    return sum;
  }

  template <int B>
  WideInteger<std::max(kCapacity, B) + 1> operator-(const WideInteger<B>& b) const {
    WideInteger<std::max(kCapacity, B) + 1> difference;
    difference.set_sum(*this, b, !b.negative_);
    return difference;
  }

  template <int B>
  WideInteger<kCapacity + B> operator*(const WideInteger<B>& b) const {
    WideInteger<kCapacity + B> product;
    if (size_ == 0 || b.size_ == 0) return product;
    std::fill(product.limbs_, product.limbs_ + b.size_, std::uint64_t{0});
    for (int i = 0; i < size_; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        const UInt128 term = static_cast<UInt128>(limbs_[i]) * b.limbs_[j] + product.limbs_[i + j] + carry;
        product.limbs_[i + j] = static_cast<std::uint64_t>(term);
        carry = static_cast<std::uint64_t>(term >> 64);
      }
      product.limbs_[i + b.size_] = carry;
    }
    product.negative_ = negative_ != b.negative_;
    product.size_ = size_ + b.size_;
    product.trim();
    return product;
  }

 private:
  template <int>
  friend class WideInteger;

  // Adds a limb on top; a zero limb may not be left on top when an operation ends.
  void push(std::uint64_t limb) {
    if (limb == 0 && size_ == kCapacity) return;
    assert(size_ < kCapacity);
    limbs_[size_++] = limb;
  }

  void trim() {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  }

  template <int B>
  bool magnitude_less(const WideInteger<B>& b) const {
    if (size_ != b.size_) return size_ < b.size_;
    for (int i = size_ - 1; i >= 0; --i) {
      if (limbs_[i] != b.limbs_[i]) return limbs_[i] < b.limbs_[i];
    }
    return false;
  }

  // *this = |a| + |b|, where a has at least as many limbs as b.
  template <int A, int B>
  void add_magnitudes(const WideInteger<A>& a, const WideInteger<B>& b) {
    std::uint64_t carry = 0;
    for (int i = 0; i < a.size_; ++i) {
      const UInt128 sum = static_cast<UInt128>(a.limbs_[i]) + (i < b.size_ ? b.limbs_[i] : 0) + carry;
      limbs_[i] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    size_ = a.size_;
    if (carry != 0) push(carry);
  }

  // *this = |a| - |b|, where |a| >= |b|.
  template <int A, int B>
  void subtract_magnitudes(const WideInteger<A>& a, const WideInteger<B>& b) {
    std::uint64_t borrow = 0;
    for (int i = 0; i < a.size_; ++i) {
      const UInt128 difference = static_cast<UInt128>(a.limbs_[i]) - (i < b.size_ ? b.limbs_[i] : 0) - borrow;
      limbs_[i] = static_cast<std::uint64_t>(difference);
      borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
    }
    size_ = a.size_;
    trim();
  }

  // *this = a + b, where b counts as having the sign `b_negative`.
  template <int A, int B>
  void set_sum(const WideInteger<A>& a, const WideInteger<B>& b, bool b_negative) {
    if (a.negative_ == b_negative) {
      negative_ = a.negative_;
      a.size_ < b.size_ ? add_magnitudes(b, a) : add_magnitudes(a, b);
    } else if (a.magnitude_less(b)) {
      negative_ = b_negative;
      subtract_magnitudes(b, a);
    } else {
      negative_ = a.negative_;
      subtract_magnitudes(a, b);
    }
  }

  std::uint64_t limbs_[kCapacity];
  int size_ = 0;  // limbs in use; the highest one is not zero
  bool negative_ = false;
};

}  // namespace tact::narrowphase
