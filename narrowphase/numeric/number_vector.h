// Vectors of any kind of number whose sums and products are of the same kind.
#pragma once

namespace tact::narrowphase {

template <class Number>
bool all_zero(const Number& x, const Number& y, const Number& z) {
  return x.sign() == 0 && y.sign() == 0 && z.sign() == 0;
}

template <class Number>
struct NumberVector {
  Number x, y, z;

  friend bool operator==(const NumberVector&, const NumberVector&) = default;
  bool is_zero() const { return all_zero(x, y, z); }
  NumberVector operator-() const { return {-x, -y, -z}; }
  friend NumberVector operator+(const NumberVector& p, const NumberVector& q) {
    return {p.x + q.x, p.y + q.y, p.z + q.z};
  }
  friend NumberVector operator-(const NumberVector& p, const NumberVector& q) {
    return {p.x - q.x, p.y - q.y, p.z - q.z};
  }
  friend NumberVector operator*(const Number& s, const NumberVector& p) { return {s * p.x, s * p.y, s * p.z}; }
  friend Number dot(const NumberVector& p, const NumberVector& q) { return (p.x * q.x + p.y * q.y) + p.z * q.z; }
  friend NumberVector cross(const NumberVector& p, const NumberVector& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  }
};

}  // namespace tact::narrowphase
