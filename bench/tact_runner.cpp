#include "bench/tact_runner.h"

#include <algorithm>
#include <limits>

#include "bench/rivals/rival.h"

namespace tact::bench {
namespace {

bool share_a_vertex(const Eigen::Matrix3Xi& facets, const FacetPair& pair) {
  const auto f = facets.col(pair.a), g = facets.col(pair.b);
  return std::find_first_of(f.begin(), f.end(), g.begin(), g.end()) != f.end();
}

class Tact : public Rival {
 public:
  Tact(const Workload& workload, int threads, TactRunner::Against against)
      : workload_(workload), runner_(workload, Settings{.threads = threads}, against) {}

  void step(int frame) override { report_ = &runner_.step(frame); }

  std::vector<FacetMeeting> meetings() const override {
    std::vector<FacetMeeting> all;
    for (const Contact& contact : report_->contacts()) {
      for (const FacetPair& pair : contact.facet_pairs()) {
        // Of one body only what its rivals find, too.
        if (contact.a == contact.b && share_a_vertex(workload_.bodies[contact.a.index].facets, pair)) continue;
        all.push_back({static_cast<int>(contact.a.index), static_cast<int>(contact.b.index), pair.a, pair.b});
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  const Workload& workload_;
  TactRunner runner_;
  const Report* report_ = nullptr;
};

}  // namespace

TactRunner::TactRunner(const Workload& workload, const Settings& settings, Against against, double margin)
    : workload_(workload), world_(settings) {
  for (const WorkloadBody& body : workload.bodies) {
    ids_.push_back(world_.add_body({.positions = body.positions(0),
                                    .facets = body.facets,
                                    .surface = body.surface,
                                    .motion = body.fixed() ? Motion::fixed : Motion::deformable,
                                    .mask = against == Against::self ? 0 : body.mask,
                                    .margin = margin,
                                    .self_contact = against == Against::self}));
  }
  updates_.reserve(ids_.size());
}

const Report& TactRunner::step(int frame) { return step_few(frame, std::numeric_limits<std::size_t>::max()); }

const Report& TactRunner::step_few(int frame, std::size_t count) {
  updates_.clear();
  for (std::size_t k = 0; k < ids_.size() && updates_.size() < count; ++k) {
    const WorkloadBody& body = workload_.bodies[k];
    if (!body.fixed()) updates_.push_back({ids_[k], body.positions(frame)});
  }
  world_.set_positions(updates_);
  return world_.detect();
}

std::unique_ptr<Rival> make_tact(const Workload& workload, int threads) {
  return std::make_unique<Tact>(workload, threads, TactRunner::Against::others);
}

std::unique_ptr<Rival> make_tact_self(const Workload& workload, int threads) {
  return std::make_unique<Tact>(workload, threads, TactRunner::Against::self);
}

}  // namespace tact::bench
