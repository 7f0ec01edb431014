// What a rank held and sent.
#pragma once

#include <array>
#include <cstdint>

namespace tact::mpi {

/// Counts of one call on one rank. Bytes are of what is sent to other ranks.
struct Statistics {
  std::int64_t own_bodies = 0;       ///< bodies that this rank owns
  std::int64_t shared_bodies = 0;    ///< fixed bodies that every rank holds
  std::int64_t ghosts = 0;           ///< copies of bodies of other ranks that the call read
  std::int64_t kept_shapes = 0;      ///< shapes of bodies that were near, kept for when they come back
  std::int64_t boxes = 0;            ///< boxes that this rank compared for all
  std::int64_t pairs = 0;            ///< pairs of bodies that this rank looked at
  std::int64_t far_contacts = 0;     ///< contacts that other ranks found of bodies of this one
  std::int64_t messages = 0;         ///< messages to other ranks
  std::int64_t bytes = 0;            ///< bytes of all messages
  std::int64_t box_bytes = 0;        ///< of them, boxes and who is near whom
  std::int64_t shape_bytes = 0;      ///< of them, whole bodies: facets, and where they are
  std::int64_t positions_bytes = 0;  ///< of them, positions and poses of bodies that are known there
  std::int64_t result_bytes = 0;     ///< of them, what this rank found of bodies of others
  std::int64_t moved_bodies = 0;     ///< bodies that this rank gave to others
  std::int64_t moved_bytes = 0;      ///< bytes of these
  std::int64_t work = 0;             ///< what its bodies cost: a sum of vertices, pairs, kept facets and points
  double imbalance = 1.0;            ///< the work of the busiest rank over the mean
};

/// A count of Statistics.
struct StatisticsCount {
  const char* name;                      ///< as in Statistics
  std::int64_t Statistics::*value = {};  ///< the member
};

/// All counts of Statistics, in their order.
inline constexpr std::array kStatisticsCounts{
    StatisticsCount{"own_bodies", &Statistics::own_bodies},
    StatisticsCount{"shared_bodies", &Statistics::shared_bodies},
    StatisticsCount{"ghosts", &Statistics::ghosts},
    StatisticsCount{"kept_shapes", &Statistics::kept_shapes},
    StatisticsCount{"boxes", &Statistics::boxes},
    StatisticsCount{"pairs", &Statistics::pairs},
    StatisticsCount{"far_contacts", &Statistics::far_contacts},
    StatisticsCount{"messages", &Statistics::messages},
    StatisticsCount{"bytes", &Statistics::bytes},
    StatisticsCount{"box_bytes", &Statistics::box_bytes},
    StatisticsCount{"shape_bytes", &Statistics::shape_bytes},
    StatisticsCount{"positions_bytes", &Statistics::positions_bytes},
    StatisticsCount{"result_bytes", &Statistics::result_bytes},
    StatisticsCount{"moved_bodies", &Statistics::moved_bodies},
    StatisticsCount{"moved_bytes", &Statistics::moved_bytes},
    StatisticsCount{"work", &Statistics::work},
};

}  // namespace tact::mpi
