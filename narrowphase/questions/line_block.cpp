#include "narrowphase/questions/line_block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "narrowphase/mesh/prefetch.h"

namespace tact::narrowphase {

namespace {

// A segment from farther away, in half sizes of the mesh, is asked alone: floats know too little of it.
constexpr double kFarthest = 1024.0;
// Up to so many clusters are held against a segment one by one: a group more or less costs as much.
constexpr int kMostWithoutGroups = 192;

// The floats of so many clusters stay in the second level of the cache: they are not prefetched.
constexpr int kMostInCache = 512;

void ask_alone(const QuestionedMesh& mesh, FirstHitQuestion& question) {
  if (const auto hit = first_hit(mesh.mesh, question.line, question.latest)) question.take(*hit);
}

void set_latest(EnteringLine& entering, double latest) {
  entering.latest = static_cast<float>(latest * (1.0 + 0x1p-22) + 0x1p-100);
}

// In the unit of a mesh. Times are wrong by what four roundings of 2^-24 take from a coordinate, of the line or of a
// box, over the way: sixteen are allowed for. Where the line goes along an axis no way, it goes one that is less than
// that.
bool set_out(const MeshBoxes& boxes, const FirstHitQuestion& question, EnteringLine& entering) {
  constexpr double kSteepest = 0x1p60;
  const double unit = 1.0 / boxes.scale;  // a power of two
  const SegmentSlabs& slabs = question.line.slabs();
  for (int axis = 0; axis < 3; ++axis) {
    const double from = (slabs.from[axis] - boxes.origin[axis]) * boxes.scale;
    if (!(std::abs(from) <= kFarthest)) return false;
    const double inverse =
        slabs.inverse[axis] == 0.0 ? kSteepest : std::clamp(slabs.inverse[axis] * unit, -kSteepest, kSteepest);
    const double slack = 0x1p-20 * (std::abs(from) + 2.0) * std::abs(inverse) + 0x1p-100;
    entering.inverse[axis] = static_cast<float>(inverse);
    entering.enter_at[axis] = static_cast<float>(from * inverse + slack);
    entering.leave_at[axis] = static_cast<float>(from * inverse - slack);
  }
  entering.count = 0;
  entering.overflows = false;
  set_latest(entering, question.latest);
  return true;
}

// Segments that are asked of one mesh together.
class Block {
 public:
  Block(const QuestionedMesh& questioned, const MeshBoxes& boxes) : questioned_(questioned), boxes_(boxes) {}

  // Returns false where floats do not do.
  bool add(FirstHitQuestion& question) {
    Asking& one = asking_[count_];
    one.question = &question;
    one.entering = &entering_[count_];
    if (question.line.is_point() || !set_out(boxes_, question, *one.entering)) return false;
    ++count_;
    if (mesh_.cluster_count() <= kMostWithoutGroups) {
      kernels_.enter_lined_boxes(boxes_.clusters, 0, mesh_.cluster_count(), 0, one.entering);
    } else {
      kernels_.enter_lined_boxes(boxes_.groups, 0, mesh_.group_count(), -1, one.entering);
    }
    return true;
  }

  void answer() {
    for (find_next(); count_ > 0; find_next()) {
      find_facets();
      if (mesh_.cluster_count() > kMostInCache) prefetch_facets();
      for (std::size_t i = 0; i < count_; ++i) meet_facets(asking_[i]);
    }
  }

 private:
  struct Asking {
    FirstHitQuestion* question;
    EnteringLine* entering;
    const LinedFacets* lined;  // of the cluster that it entered last
    std::uint64_t facets;      // of that cluster, that it may meet
  };

  // The clusters that the segments enter next; those that enter no more have their answer.
  void find_next() {
    std::size_t left = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Asking one = asking_[i];
      if (find_next(*one.entering)) {
        asking_[left++] = one;
      } else if (one.entering->overflows) {
        ask_alone(questioned_, *one.question);
      }
    }
    count_ = left;
    for (std::size_t i = 0; i < count_; ++i) {
      Asking& one = asking_[i];
      one.lined = questioned_.room->facets(mesh_, questioned_.number, one.entering->taken);
      if (one.lined != nullptr && mesh_.cluster_count() > kMostInCache) prefetch_lines(one.lined, 1);
    }
  }

  bool find_next(EnteringLine& entering) const {
    while (!entering.overflows && kernels_.take_nearest(&entering)) {
      if (entering.taken >= 0) return true;
      const int group = ~entering.taken, begin = mesh_.cluster_begin(group);
      kernels_.enter_lined_boxes(boxes_.clusters, begin, mesh_.cluster_end(group) - begin, 0, &entering);
    }
    return false;
  }

  void find_facets() {
    for (std::size_t i = 0; i < count_; ++i) {
      Asking& one = asking_[i];
      const Sightline& line = one.question->line;
      one.facets = one.lined != nullptr ? kernels_.facets_on_line(*one.lined, line.line())
                                        : line.facets_seen(mesh_, one.entering->taken);
    }
  }

  void prefetch_facets() const {
    for (std::size_t i = 0; i < count_; ++i) {
      const Asking& one = asking_[i];
      if (one.facets == 0) continue;
      for (const int v : mesh_.corners(mesh_.facet_begin(one.entering->taken) + std::countr_zero(one.facets)))
        prefetch_position(mesh_, v);
    }
  }

  void meet_facets(Asking& one) {
    for (std::uint64_t rest = one.facets; rest != 0; rest &= rest - 1) {
      const int f = mesh_.facet_begin(one.entering->taken) + std::countr_zero(rest);
      const auto place = one.question->line.meet(mesh_.triangle(f), counts_);
      if (!place) continue;
      one.question->take({mesh_.source_facet(f), place->time, place->weight});
      set_latest(*one.entering, one.question->latest);
    }
  }

  const QuestionedMesh& questioned_;
  const ClusteredMesh& mesh_ = questioned_.mesh;
  const MeshBoxes& boxes_;
  const Kernels& kernels_ = kernels();
  EnteringLine entering_[kLinesAtATime];
  Asking asking_[kLinesAtATime];
  std::size_t count_ = 0;
  PredicateCounts counts_;
};

}  // namespace

void ask_first_hits(const QuestionedMesh& questioned, std::span<FirstHitQuestion* const> questions) {
  const ClusteredMesh& mesh = questioned.mesh;
  if (mesh.facet_count() == 0) return;
  const MeshBoxes* const boxes = questioned.room == nullptr ? nullptr : questioned.room->boxes(mesh, questioned.number);
  if (boxes == nullptr) {
    for (FirstHitQuestion* const question : questions) ask_alone(questioned, *question);
    return;
  }
  Block block(questioned, *boxes);
  for (FirstHitQuestion* const question : questions) {
    if (!block.add(*question)) ask_alone(questioned, *question);
  }
  block.answer();
}

}  // namespace tact::narrowphase
