#include <tact/kept_report.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/base/floating_point_mode.h"
#include "engine/with_memory.h"

namespace tact {

namespace {

// Lists of contacts, one after the other. They are copied before any is shown, as memory may move.
template <class Item>
class ListCopies {
 public:
  void clear() { items_.clear(), next_ = 0; }
  void add(std::span<const Item> list) { items_.insert(items_.end(), list.begin(), list.end()); }
  // Those that were added, in their order.
  std::span<Item> take(std::size_t size) { return std::span(items_).subspan(std::exchange(next_, next_ + size), size); }

 private:
  std::vector<Item> items_;
  std::size_t next_ = 0;
};

}  // namespace

struct KeptReport::Lists {
  Report report;
  ListCopies<FacetPair> facet_pairs;
  ListCopies<ContactPoint> points;
  ListCopies<ReachPair> within_reach;
  ListCopies<Patch> patches;
  ListCopies<int> of_patches;
  ListCopies<IntersectionCurve> curves;
  ListCopies<CurvePoint> of_curves;

  void clear() {
    facet_pairs.clear(), points.clear(), within_reach.clear();
    patches.clear(), of_patches.clear(), curves.clear(), of_curves.clear();
  }
};

KeptReport::KeptReport()
    : lists_(with_memory("keeping a report ran out of memory", [] { return std::make_unique<Lists>(); })) {}
KeptReport::~KeptReport() = default;
KeptReport::KeptReport(KeptReport&&) noexcept = default;
KeptReport& KeptReport::operator=(KeptReport&&) noexcept = default;

const Report& KeptReport::report() const noexcept { return lists_->report; }

void KeptReport::keep(const Report& report) {
  const base::FloatingPointMode mode;
  if (&report == &lists_->report) return;
  Lists& own = *lists_;
  Report& to = own.report;
  to.contacts_.clear();  // they view lists that are written now
  own.clear();
  const auto copy = [&] {
    for (const Contact& contact : report.contacts_) {
      own.facet_pairs.add(contact.facet_pairs_);
      own.points.add(contact.points_);
      own.within_reach.add(contact.within_reach_);
      own.patches.add(contact.patches_);
      own.curves.add(contact.curves_);
      for (const Patch& patch : contact.patches_)
        own.of_patches.add(patch.facet_pairs), own.of_patches.add(patch.points);
      for (const IntersectionCurve& curve : contact.curves_) own.of_curves.add(curve.points);
    }
    to.candidate_pairs_ = report.candidate_pairs_;
    to.began_ = report.began_, to.ended_ = report.ended_, to.patch_events_ = report.patch_events_;
    to.keys_ = report.keys_, to.stats_ = report.stats_, to.trace_ = report.trace_;
    to.contacts_ = report.contacts_;
    for (Contact& contact : to.contacts_) {
      contact.facet_pairs_ = own.facet_pairs.take(contact.facet_pairs_.size());
      contact.points_ = own.points.take(contact.points_.size());
      contact.within_reach_ = own.within_reach.take(contact.within_reach_.size());
      const std::span<Patch> patches = own.patches.take(contact.patches_.size());
      for (Patch& patch : patches) {
        patch.facet_pairs = own.of_patches.take(patch.facet_pairs.size());
        patch.points = own.of_patches.take(patch.points.size());
      }
      contact.patches_ = patches;
      const std::span<IntersectionCurve> curves = own.curves.take(contact.curves_.size());
      for (IntersectionCurve& curve : curves) curve.points = own.of_curves.take(curve.points.size());
      contact.curves_ = curves;
    }
  };
  with_memory("keeping a report ran out of memory", [&] {
    try {
      copy();
    } catch (...) {
      to = Report();
      throw;
    }
  });
}

}  // namespace tact
