// What a whole report holds, as arrays of the program: a row a point, a facet pair or an impact, over all bodies.
#pragma once

#include <tact/motion.h>
#include <tact/report.h>
#include <tact/world.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace tact {

/// Arrays for the contact points of a whole report. An empty one is left out.
struct PointArrays {
  std::span<std::uint32_t> bodies = {};     ///< the index of body a and of body b, 2 a point
  std::span<int> contacts = {};             ///< the number of its contact, counted from 0
  std::span<std::uint8_t> kinds = {};       ///< which features these are, as numbers
  std::span<int> a_vertices = {};           ///< vertices of a, 3 a point; -1 fills up
  std::span<int> b_vertices = {};           ///< vertices of b, 3 a point; -1 fills up
  std::span<double> a_weights = {};         ///< weights of the vertices of a, 3 a point
  std::span<double> b_weights = {};         ///< weights of the vertices of b, 3 a point
  std::span<double> normals = {};           ///< unit vectors from a to b, 3 a point
  std::span<double> gaps = {};              ///< metres; negative where the surfaces have crossed
  std::span<std::uint64_t> ids = {};        ///< the same in every step in which these features are near
  std::span<std::uint64_t> patch_ids = {};  ///< ids of the patches, or 0 where patches are not requested
  std::span<std::uint8_t> minima = {};      ///< 1 if nothing beside it on either surface is nearer, else 0
};

/// Arrays for the labels of what the points of a whole report name; 0 where there is none. An empty one is left out.
struct PointLabelArrays {
  std::span<std::uint32_t> a_facets = {};    ///< that of a's facet, or of the first that has the vertex or the edge
  std::span<std::uint32_t> b_facets = {};    ///< the same of b
  std::span<std::uint32_t> a_vertices = {};  ///< those of a's vertices, 3 a point
  std::span<std::uint32_t> b_vertices = {};  ///< those of b's vertices, 3 a point
};

/// Arrays for the facet pairs of a whole report. An empty one is left out.
struct FacetPairArrays {
  std::span<std::uint32_t> bodies = {};  ///< the index of body a and of body b, 2 a pair
  std::span<int> contacts = {};          ///< the number of its contact, counted from 0
  std::span<int> facets = {};            ///< the facet of a and that of b, 2 a pair
};

/// Arrays for the pairs within reach of a whole report. An empty one is left out.
struct ReachPairArrays {
  std::span<std::uint32_t> bodies = {};  ///< the index of body a and of body b, 2 a pair
  std::span<int> contacts = {};          ///< the number of its contact, counted from 0
  std::span<std::uint8_t> kinds = {};    ///< which features these are, as numbers
  std::span<int> a_vertices = {};        ///< vertices of a, 3 a pair; -1 fills up
  std::span<int> b_vertices = {};        ///< vertices of b, 3 a pair; -1 fills up
  std::span<double> a_weights = {};      ///< weights of the vertices of a, 3 a pair
  std::span<double> b_weights = {};      ///< weights of the vertices of b, 3 a pair
  std::span<double> normals = {};        ///< unit vectors from a to b, 3 a pair; zero where the distance is
  std::span<double> distances = {};      ///< metres
};

/// Arrays for the impacts of a motion report. An empty one is left out.
struct ImpactArrays {
  std::span<std::uint32_t> bodies = {};  ///< the index of body a and of body b, 2 an impact
  std::span<std::uint8_t> kinds = {};    ///< which features meet, as numbers
  std::span<double> times = {};          ///< the parts of the way, 0 to 1, at which they first meet
  std::span<int> a_vertices = {};        ///< vertices of a, 3 an impact; -1 fills up
  std::span<int> b_vertices = {};        ///< vertices of b, 3 an impact; -1 fills up
  std::span<std::uint8_t> stops = {};    ///< 0 where they part or slide along each other, else 1
};

/// Returns the number of contact points of all contacts.
TACT_API std::size_t point_count(const Report& report);
/// Returns the number of pairs within reach of all contacts.
TACT_API std::size_t reach_pair_count(const Report& report);
/// Returns the number of facet pairs of all contacts.
TACT_API std::size_t facet_pair_count(const Report& report);

/// Fills arrays with the points of all contacts, in their order. Errors: wrong_size (an array is neither empty nor has
/// a row for each of point_count()).
TACT_API void copy_points(const Report& report, const PointArrays& arrays);
/// Fills arrays with the labels of the points of all contacts of a world's last report, in their order. Errors:
/// wrong_size, stale_body (a body of the report was removed), wrong_order (set_facets() took a vertex of a point away).
TACT_API void copy_point_labels(const World& world, const Report& report, const PointLabelArrays& arrays);
/// Fills arrays with the pairs within reach of all contacts, in their order. Errors: wrong_size.
TACT_API void copy_reach_pairs(const Report& report, const ReachPairArrays& arrays);
/// Fills arrays with the facet pairs of all contacts, in their order. Errors: wrong_size.
TACT_API void copy_facet_pairs(const Report& report, const FacetPairArrays& arrays);
/// Fills arrays with the impacts of a motion report, in their order. Errors: wrong_size.
TACT_API void copy_impacts(const MotionReport& report, const ImpactArrays& arrays);

}  // namespace tact
