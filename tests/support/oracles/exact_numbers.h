// Exact numbers of the oracles: those of GMP, or where there is no GMP for the platform those of Boost and CGAL, which
// are slower.
#pragma once

#ifdef CGAL_DISABLE_GMP
#include <CGAL/MP_Float.h>

#include <boost/multiprecision/cpp_int.hpp>
#else
#include <CGAL/Gmpzf.h>
#include <CGAL/gmpxx.h>
#endif

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace tact::tests {

// The operators of integers; abs() and gcd() are found by the arguments.
#ifdef CGAL_DISABLE_GMP
using ExactInteger =
    boost::multiprecision::number<boost::multiprecision::cpp_int::backend_type, boost::multiprecision::et_off>;
using ExactFloat = CGAL::MP_Float;  // an integer times a power of two
#else
using ExactInteger = mpz_class;
using ExactFloat = CGAL::Gmpzf;
#endif

inline int sign_of(const ExactInteger& x) {
#ifdef CGAL_DISABLE_GMP
  return x.sign();
#else
  return sgn(x);
#endif
}

// Bits of the magnitude; 1 for zero.
inline std::size_t bits_of(const ExactInteger& x) {
#ifdef CGAL_DISABLE_GMP
  return x.is_zero() ? 1 : msb(abs(x)) + 1;
#else
  return mpz_sizeinbase(x.get_mpz_t(), 2);
#endif
}

// The 53 leading bits of x * 2^exponent; x may be larger than any double.
inline double scaled(const ExactInteger& x, long exponent) {
#ifdef CGAL_DISABLE_GMP
  const std::size_t bits = bits_of(x), dropped = bits > 53 ? bits - 53 : 0;
  const double leading = ExactInteger(abs(x) >> dropped).convert_to<double>();
  return std::ldexp(x.sign() < 0 ? -leading : leading, static_cast<int>(exponent + static_cast<long>(dropped)));
#else
  long own = 0;
  const double mantissa = mpz_get_d_2exp(&own, x.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(own + exponent));
#endif
}

// Doubles on both sides of x * 2^exponent, x not negative; one if it is a double.
inline std::pair<double, double> enclosed(const ExactInteger& x, long exponent) {
  const double low = scaled(x, exponent);
  const std::size_t dropped = bits_of(x) > 53 ? bits_of(x) - 53 : 0;
  const ExactInteger leading = x >> dropped;
  const bool is_exact = ExactInteger(leading << dropped) == x;
  return {low, is_exact ? low : std::nextafter(low, std::numeric_limits<double>::infinity())};
}

}  // namespace tact::tests
