// Clusters that a search has opened: it copies what it needs of a cluster and keeps the copy, as in a sorted list of
// pairs neighbours come soon again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tact::narrowphase {

/// Up to `kPlaces` clusters of one mesh. Each stays open until another takes its place, which its number tells.
template <class Opened, std::size_t kPlaces>
class OpenClusters {
 public:
  OpenClusters() { close(); }

  /// Closes all: before another mesh, or where what is copied changes.
  void close() { std::ranges::fill(cluster_, -1); }

  /// A cluster, after open(Opened&) if it is not open. It takes any place but that of `beside`.
  template <class Open>
  Opened& get(int cluster, const Open& open, const Opened* beside = nullptr) {
    std::size_t place = static_cast<std::size_t>(cluster) % kPlaces;
    if (&opened_[place] == beside) place = kPlaces;
    if (std::exchange(cluster_[place], cluster) != cluster) open(opened_[place]);
    return opened_[place];
  }
  /// The i-th place, closed, for what its caller puts there.
  Opened& place(int i) {
    cluster_[i] = -1;
    return opened_[i];
  }

 private:
  Opened opened_[kPlaces + 1];  // and one that would have the place of `beside`
  int cluster_[kPlaces + 1];    // apart from them, so that a look-up reads nothing of another cluster
};

}  // namespace tact::narrowphase
