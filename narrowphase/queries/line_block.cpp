#include "narrowphase/queries/line_block.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "narrowphase/mesh/prefetch.h"
#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

namespace {

// Up to so many nodes are held against a segment one by one: a group more or less costs as much.
constexpr int kMostWithoutGroups = 64;
// The leaves of so many nodes, of 10 kB, stay in the second level of the cache: their vertices are not prefetched.
constexpr int kMostInCache = 128;

void ask_alone(const ClusteredMesh& mesh, FirstHitQuery& query) {
  if (const auto hit = first_hit(mesh, PreparedSegment(query.segment), query.latest)) query.take(*hit);
}

// Segments that are cast at one mesh together.
class Block {
 public:
  Block(const ClusteredMesh& mesh, const LineTree& tree, std::span<FirstHitQuery* const> queries)
      : mesh_(mesh), tree_(tree), queries_(queries) {
    for (std::size_t i = 0; i < kLinesAtATime; ++i) {
      const FirstHitQuery& query = *queries[i < queries.size() ? i : 0];
      const Vec3 from = query.segment[0];
      for (int axis = 0; axis < 3; ++axis) {
        const DoubleDouble way = two_sum(query.segment[1][axis], -from[axis]);
        block_.from[axis][i] = from[axis];
        block_.direction[axis][i] = way.head;
        block_.direction_tail[axis][i] = way.tail;
      }
      set_latest(i, query.latest);
    }
    const LinesApart apart = kernels_.prepare_segments(tree, &block_);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if ((apart.alone >> i & 1U) != 0) ask_alone(mesh, *queries[i]);
      if (((apart.alone | apart.past) >> i & 1U) == 0) lines_[count_++] = static_cast<std::uint8_t>(i);
    }
  }

  void answer() {
    if (tree_.node_count <= kMostWithoutGroups) {
      kernels_.enter_all_nodes(tree_, &block_);
    } else {
      for (int i = 0; i < count_; ++i) kernels_.enter_groups(tree_, lines_[i], &block_);
    }
    for (find_facets(); count_ > 0; find_facets()) {
      list_pairs();
      decide_pairs();
    }
  }

 private:
  // Of the segment at a place of the block.
  void set_latest(std::size_t line, double latest) {
    block_.latest[line] = static_cast<float>(latest * (1.0 + 0x1p-22) + 0x1p-100);
  }

  // Facets that the segments may meet next; those for which there are none have their answer.
  void find_facets() {
    std::uint8_t asking[kLinesAtATime];
    std::copy_n(lines_, count_, asking);
    for (int asking_count = count_; asking_count > 0; asking_count = open_nodes(asking, asking_count))
      kernels_.find_facets(tree_, asking, asking_count, &block_);
    int left = 0;
    for (int i = 0; i < count_; ++i) {
      const std::uint8_t line = lines_[i];
      if ((block_.overflowing >> line & 1U) != 0) {
        ask_alone(mesh_, *queries_[line]);
        continue;
      }
      const std::int32_t taken = block_.taken[line];
      if (tree_.node_count > kMostInCache && taken >= 0)
        prefetch_corners(tree_.leaf[taken], std::countr_zero(block_.facets[line]));
      lines_[left] = line;
      left += static_cast<int>(taken >= 0);
    }
    count_ = left;
  }

  // Of the segments that asked, those that came to a group or are left with later nodes enter what is in them. These
  // are to ask again; returns how many there are. Which ones is not to be guessed: the list is written without a
  // branch.
  int open_nodes(std::uint8_t* asking, int count) {
    constexpr auto kNothing = static_cast<std::uint32_t>(LineBlock::kNothing);
    std::uint32_t later = 0;
    int again = 0;
    for (int i = 0; i < count; ++i) {
      const std::uint8_t line = asking[i];
      const std::int32_t taken = block_.taken[line];
      const std::uint32_t asks_later = static_cast<std::uint32_t>(taken == LineBlock::kLaterNodes);
      later |= asks_later << line;
      // Any other negative number but kNothing is a group.
      if (static_cast<std::uint32_t>(taken) > kNothing + 1) {
        const int begin = ~taken * kNodesOfGroup;
        kernels_.enter_nodes(tree_, begin, std::min(kNodesOfGroup, tree_.node_count - begin), line, &block_);
      }
      asking[again] = line;
      again += static_cast<int>(static_cast<std::uint32_t>(taken) > kNothing);
    }
    if (later != 0) kernels_.enter_later_nodes(tree_, later, &block_);
    return again;
  }

  void list_pairs() {
    for (int i = 0; i < count_; ++i) {
      for (std::uint32_t facets = block_.facets[lines_[i]]; facets != 0; facets &= facets - 1) {
        if (pairs_.count == LinePairs::kMost) decide_pairs();
        add_pair(lines_[i], block_.taken[lines_[i]], std::countr_zero(facets));
      }
    }
  }

  void prefetch_corners(const LineLeaf& leaf, int facet) const {
    for (const auto& vertex : leaf.vertex) prefetch_position(mesh_, vertex[facet]);
  }

  void add_pair(int line, int leaf, int facet) {
    const int place = pairs_.count++, last = static_cast<int>(block_.longest[line]);
    const PointArrays points = mesh_.points();
    const double* const along[5] = {points.x, points.y, points.z, points.x, points.y};
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = tree_.leaf[leaf].vertex[k][facet];
      pairs_.corner[k][0][place] = along[last + 1][v];
      pairs_.corner[k][1][place] = along[last + 2][v];
      pairs_.corner[k][2][place] = along[last][v];
    }
    pairs_.line[place] = line;
    facet_[place] = leaf * LineLeaf::kFacets + facet;
  }

  void decide_pairs() {
    for (int i = pairs_.count; i < LinePairs::kMost; ++i) pairs_.line[i] = 0;
    kernels_.meet_lines(block_, &pairs_);
    for (std::uint32_t left = pairs_.meets | pairs_.uncertain; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      const auto line = static_cast<std::size_t>(pairs_.line[i]);
      FirstHitQuery& query = *queries_[line];
      CommonPlace place{pairs_.time[i], {pairs_.weight[0][i], pairs_.weight[1][i], pairs_.weight[2][i]}};
      if ((pairs_.uncertain >> i & 1U) != 0) {
        const auto met = PreparedSegment(query.segment).meet(mesh_.triangle(facet_[i]), counts_);
        if (!met) continue;
        place = *met;
      }
      if (!mesh_.is_of_surface(mesh_.source_facet(facet_[i]))) continue;
      query.take({mesh_.source_facet(facet_[i]), place.time, place.weight});
      set_latest(line, query.latest);
    }
    pairs_.count = 0;
  }

  const ClusteredMesh& mesh_;
  const LineTree& tree_;
  const std::span<FirstHitQuery* const> queries_;
  const Kernels& kernels_ = kernels();
  LineBlock block_;
  std::uint8_t lines_[kLinesAtATime];  // of the block, those that have not ended
  int count_ = 0;
  LinePairs pairs_;
  int facet_[LinePairs::kMost];  // of each pair
  PredicateCounts counts_;
};

}  // namespace

void ask_first_hits(const ClusteredMesh& mesh, const LineTree* tree, std::span<FirstHitQuery* const> queries) {
  if (tree != nullptr) return Block(mesh, *tree, queries).answer();
  for (FirstHitQuery* const query : queries) ask_alone(mesh, *query);
}

}  // namespace tact::narrowphase
