#include <fmt/format.h>
#include <tact/world.h>

#include "bench/error/methods.h"

namespace tact::bench {
namespace {

// Pairs stand 16 m apart, so that none is a candidate with another; that shift is exact.
Eigen::Vector3d place_of(std::size_t pair) {
  return 16.0 * Eigen::Vector3d(static_cast<double>(pair % 4), static_cast<double>(pair / 4 % 4),
                                static_cast<double>(pair / 16));
}

class TactHulls : public HullMethod {
 public:
  TactHulls(const HullRow& row, const Settings& settings) : world_(settings), positions_(row.pairs.size()) {
    for (std::size_t i = 0; i < row.pairs.size(); ++i) {
      const HullPair& pair = row.pairs[i];
      const Eigen::Matrix3Xd a = pair.a.positions.colwise() + place_of(i);
      for (const Eigen::Vector3d& shift : pair.path)
        positions_[i].push_back(pair.b.positions.colwise() + (place_of(i) + shift));
      world_.add_body({.positions = a, .facets = pair.a.facets});
      moving_.push_back(world_.add_body({.positions = positions_[i][0], .facets = pair.b.facets}));
    }
  }

  void step(int frame) override {
    updates_.clear();
    for (std::size_t i = 0; i < moving_.size(); ++i) updates_.push_back({moving_[i], positions_[i][frame]});
    world_.set_positions(updates_);
    report_ = &world_.detect();
  }

  HullAnswer answer(std::size_t pair) const override {
    for (const Contact& contact : report_->contacts()) {
      if (contact.b == moving_[pair]) return {true, contact.depth, contact.direction, contact.limit_reached};
    }
    return {};
  }

 private:
  World world_;
  std::vector<std::vector<Eigen::Matrix3Xd>> positions_;  // of each moving body, a matrix a frame
  std::vector<BodyId> moving_;
  std::vector<PositionsUpdate> updates_;
  const Report* report_ = nullptr;
};

}  // namespace

std::vector<HullMethodKind> tact_hull_methods() {
  std::vector<HullMethodKind> kinds;
  for (const DirectionPolicy policy : {DirectionPolicy::carried, DirectionPolicy::smallest}) {
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
      const bool carried = policy == DirectionPolicy::carried;
      const Settings settings{
          .threads = 1, .accuracy = Accuracy::hulls, .direction = policy, .gjk_tolerance = tolerance};
      kinds.push_back({"tact", fmt::format("{}, {:.0e}", carried ? "carried" : "smallest", tolerance),
                       carried ? Minimum::local : Minimum::smallest,
                       [settings](const HullRow& row) { return std::make_unique<TactHulls>(row, settings); }});
    }
  }
  return kinds;
}

}  // namespace tact::bench
