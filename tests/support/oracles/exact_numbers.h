// Exact numbers of the oracles: those of GMP, or where there is no GMP for the platform those of Boost and CGAL, which are
// slower.
#pragma once

#include <CGAL/number_utils.h>
#ifdef CGAL_DISABLE_GMP
#include <CGAL/MP_Float.h>
#include <CGAL/boost_mp.h>
#else
#include <CGAL/Gmpzf.h>
#include <CGAL/gmpxx.h>
#endif

#include <cmath>
#include <cstddef>

namespace tact::tests {

#ifdef CGAL_DISABLE_GMP
using ExactInteger = boost::multiprecision::number<boost::multiprecision::cpp_int::backend_type, boost::multiprecision::et_off>;
using ExactFloat = CGAL::MP_Float;  // an integer times a power of two
#else
using ExactInteger = mpz_class;
using ExactFloat = CGAL::Gmpzf;
#endif

// Bits of the magnitude; 1 for zero.
inline std::size_t bits_of(const ExactInteger& x) {
#ifdef CGAL_DISABLE_GMP
  return x.is_zero() ? 1 : msb(abs(x)) + 1;
#else
  return mpz_sizeinbase(x.get_mpz_t(), 2);
#endif
}

// x * 2^exponent to the 53 leading bits; x may be larger than any double.
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

}  // namespace tact::tests
