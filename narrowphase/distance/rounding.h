// How signs and numbers of this folder are rounded.
//
// Signs decide which features hold a point. Each is that of a sum of products of differences of points.
//   1. In doubles. Beyond kSignRounding times the product of the lengths that are multiplied the sign is certain: 16
//      roundings of 2^-53 are in the longest sum, 256 leave room. The kernels decide by this step alone, with the same
//      operations, and leave what it does not tell.
//   2. In double-doubles, from exact differences of which each is scaled by a power of two to a length near 1: products
//      lose 2^-102 and sums 2^-104, so the longest sum less than 2^-97, and kFineRounding leaves room.
//   3. A facet, an edge or a vertex of which the sign is below kEqualDistance times the product is as near as its
//      neighbour, and equal distances are a minimum: coordinates have roundings of 2^-53 themselves.
// Lines that are clearly not parallel are nearest where doubles say, without a bound: an edge's end that changes sides
// is within 1e-8 of it. For nearly parallel ones the places come from double-doubles.
//
// Numbers (gaps, weights, normals) are computed in doubles where that loses a few roundings: inside facets and edges,
// in vertices, between edges that are clearly not parallel. Between nearly parallel edges they are computed in
// double-doubles and rounded once; so are normals of narrow triangles. Simplices of hulls, which may be thinner than
// 2^-53, take triple-doubles. Times of segments and distances of queries are exact numbers, rounded once:
// double-doubles where it is certain how they are rounded, else integers.
//
// All operations are +, -, *, / and square roots of doubles: the same bits on every machine.
#pragma once

namespace tact::narrowphase {

inline constexpr double kSignRounding = 256 * 0x1p-53;
inline constexpr double kFineRounding = 0x1p-92;
inline constexpr double kEqualDistance = 0x1p-56;

// Lengths are near 1. Products of lengths below this may have lost digits, or all: where one decides, it is computed
// from what is scaled, and the kernels leave it.
inline constexpr double kVanishing = 0x1p-900;

// Two edges of which the squared sine is smaller are nearly parallel.
inline constexpr double kNearlyParallel = 1e-8;

}  // namespace tact::narrowphase
