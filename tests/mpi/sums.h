// What a step found, as sums of hashes that depend on no order: of one world, and of a rank of many.
#pragma once

#include <mpi.h>
#include <tact/mpi/report.h>

#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/hash.h"

namespace tact::tests {

using Key = std::uint64_t;

inline int rank_of_all() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}
inline int count_of_ranks() {
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}

// Waits for all ranks asleep: a rank that spins would take the core of the one that is at work.
inline void wait_for_all() {
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  for (int done = 0; done == 0;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

inline int failures = 0;

inline void expect(bool holds, const std::string& what) {
  if (holds || ++failures > 20) return;
  std::fprintf(stderr, "rank %d of %d: %s\n", rank_of_all(), count_of_ranks(), what.c_str());
}

// Sums of hashes, which depend on no order.
struct Sums {
  enum { contacts, contact_count, began, ended, patch_events, curves, impacts, kinds };
  std::uint64_t of[kinds] = {};
  static constexpr const char* kNames[] = {"contacts", "number of contacts", "began", "ended", "patches", "curves",
                                           "impacts"};
  // Of a contact's hash curves are no part.
  void add(const Contact& contact) {
    of[contacts] += contact.hash();
    ++of[contact_count];
    for (const IntersectionCurve& curve : contact.curves()) {
      base::Hash hash;
      hash.add(std::uint64_t{curve.closed});
      for (const CurvePoint& point : curve.points) {
        for (int axis = 0; axis < 3; ++axis) hash.add(point.position[axis]);
      }
      of[curves] += hash.value();
    }
  }
};

inline std::uint64_t word_of(Key a, Key b, std::initializer_list<std::uint64_t> words) {
  base::Hash hash;
  hash.add(a), hash.add(b);
  for (const std::uint64_t word : words) hash.add(word);
  return hash.value();
}

inline std::uint64_t word_of(Key a, Key b, const Impact& impact) {
  base::Hash hash;
  hash.add(word_of(a, b,
                   {static_cast<std::uint64_t>(impact.kind), std::uint64_t{impact.stops},
                    std::bit_cast<std::uint64_t>(impact.time)}));
  for (const auto* vertices : {&impact.a_vertices, &impact.b_vertices}) {
    for (const int v : *vertices) hash.add(static_cast<std::uint64_t>(v));
  }
  return hash.value();
}

// What one world found.
inline Sums sums_of(const Report& report, const std::map<BodyId, Key>& keys) {
  Sums sums;
  for (const Contact& contact : report.contacts()) sums.add(contact);
  const auto key = [&](BodyId id) { return keys.at(id); };
  for (const ContactEvent& event : report.began()) sums.of[Sums::began] += word_of(key(event.a), key(event.b), {});
  for (const ContactEvent& event : report.ended()) sums.of[Sums::ended] += word_of(key(event.a), key(event.b), {});
  for (const PatchEvent& event : report.patch_events())
    sums.of[Sums::patch_events] +=
        word_of(key(event.a), key(event.b), {static_cast<std::uint64_t>(event.kind), event.patch, event.other});
  return sums;
}

// What this rank counts (or, of pairs of two ranks, what it does not count: the other owner's copies of the same).
inline Sums sums_of(const mpi::Report& report, bool counted, bool of_two_ranks) {
  Sums sums;
  const auto is_wanted = [&](const mpi::BodyPair& bodies) {
    const bool is_far = bodies.rank_a >= 0 && bodies.rank_b >= 0 && bodies.rank_a != bodies.rank_b;
    return bodies.counted == counted && (is_far || !of_two_ranks);
  };
  for (const mpi::Contact& contact : report.contacts()) {
    if (is_wanted(contact.bodies)) sums.add(contact.contact);
  }
  const auto word = [](const mpi::BodyPair& bodies, std::initializer_list<std::uint64_t> words) {
    return word_of(bodies.key_a, bodies.key_b, words);
  };
  for (const mpi::ContactEvent& event : report.began())
    if (is_wanted(event.bodies)) sums.of[Sums::began] += word(event.bodies, {});
  for (const mpi::ContactEvent& event : report.ended())
    if (is_wanted(event.bodies)) sums.of[Sums::ended] += word(event.bodies, {});
  for (const mpi::PatchEvent& event : report.patch_events())
    if (is_wanted(event.bodies))
      sums.of[Sums::patch_events] +=
          word(event.bodies, {static_cast<std::uint64_t>(event.kind), event.patch, event.other});
  return sums;
}

inline Sums over_all_ranks(Sums sums) {
  MPI_Allreduce(MPI_IN_PLACE, sums.of, Sums::kinds, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return sums;
}

// All sums of all steps so far: the same on any number of ranks.
inline base::Hash digest;
inline void add_to_digest(const Sums& sums) {
  for (const std::uint64_t sum : sums.of) digest.add(sum);
}

// What each rank holds, on all of them.
template <class Item>
std::vector<std::vector<Item>> of_each_rank(const std::vector<Item>& own) {
  int size = static_cast<int>(own.size() * sizeof(Item)), sum = 0;
  std::vector<int> sizes(count_of_ranks()), begins;
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (const int one : sizes) begins.push_back(std::exchange(sum, sum + one));
  std::vector<Item> items(sum / sizeof(Item));
  MPI_Allgatherv(own.data(), size, MPI_BYTE, items.data(), sizes.data(), begins.data(), MPI_BYTE, MPI_COMM_WORLD);
  std::vector<std::vector<Item>> all;
  for (int i = 0; i < count_of_ranks(); ++i) {
    const auto begin = items.begin() + static_cast<std::ptrdiff_t>(begins[i] / sizeof(Item));
    all.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(sizes[i] / sizeof(Item)));
  }
  return all;
}

inline void expect_same(const Sums& found, const Sums& expected, const std::string& where) {
  for (int kind = 0; kind < Sums::kinds; ++kind)
    expect(found.of[kind] == expected.of[kind], where + ": " + Sums::kNames[kind] + " differ");
}

}  // namespace tact::tests
