// What a call of detect_motion() found of pairs of bodies, for later ones in which all go a part of the same ways: a
// line search, or a solver that tries a shorter step. Of such a pair only those features are looked at again that did
// not stay apart by more than positions may be wrong; the answer is what it would be without.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "narrowphase/motion/impacts.h"

namespace tact {

class KnownWays {
 public:
  using Candidates = std::span<const narrowphase::FeatureCandidate>;

  /// Before bodies or their settings change, or where their ways begin.
  void forget() { pairs_.clear(); }

  /// Looks which bodies go a part of the ways that are known, where features meet at this distance.
  void look(const Bodies& bodies, const std::optional<double>& distance, int threads);
  /// After look(): the candidates of a pair of which both do; nothing if that is not known.
  std::optional<Candidates> find(std::uint32_t a, std::uint32_t b) const;

  /// Begins anew. No coordinate of any way is larger than `largest`.
  void begin(const Bodies& bodies, const std::optional<double>& distance, double largest);
  /// Candidates of the pair that is added next.
  void add(Candidates candidates) { candidates_.insert(candidates_.end(), candidates.begin(), candidates.end()); }
  /// They are all that may meet up to this part of the way. What is in no cluster pair of `opened` is apart by the
  /// boxes of clusters alone; null: all clusters were opened.
  void add_pair(const Bodies& bodies, std::uint32_t a, std::uint32_t b, double until,
                const std::span<const narrowphase::ClusterPair>* opened);
  /// After the last pair.
  void finish(const Bodies& bodies, int threads);

 private:
  // Where the way of a body ends.
  struct End {
    bool is_used = false;
    bool moves = false;           // if not, there is nothing else
    std::vector<char> is_opened;  // of each cluster
    std::vector<double> boxes;    // of the clusters, as its placement has them
    std::vector<double> opened;   // x, y and z of each vertex of the opened ones, borrowed ones included
    bool goes_a_part = false;     // see look()
  };
  struct Pair {
    std::uint32_t a, b;  // slots
    double until;
    std::size_t begin, end;  // of candidates_
  };
  // The coordinate of an opened cluster that goes farthest.
  struct Farthest {
    std::uint32_t slot = 0;
    int axis = 0, vertex = 0;
    double begin = 0.0, way = 0.0;
  };
  End& end_of(const Bodies& bodies, std::uint32_t slot);
  void keep_end(const Bodies& bodies, std::uint32_t slot);
  Farthest find_farthest(const Bodies& bodies) const;
  bool goes_a_part(const Bodies& bodies, std::uint32_t slot) const;

  std::vector<End> ends_;             // an entry a slot
  std::vector<std::uint32_t> slots_;  // that have one
  std::vector<Pair> pairs_;           // sorted by slots
  std::vector<narrowphase::FeatureCandidate> candidates_;
  std::optional<double> distance_;
  double largest_ = 0.0;
  std::optional<Farthest> farthest_;  // once it was looked for
  double part_ = 0.0;                 // of the way, that bodies go now
};

}  // namespace tact
