#include "scenes/commands/lost_pairs.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace tact::scenes {
namespace {

// The facet pairs that the simulation was told of the two bodies; empty if it was not told of them at all.
std::span<const FacetPair> told(const Report& report, const Contact& contact) {
  const auto contacts = report.contacts();
  const auto found =
      std::lower_bound(contacts.begin(), contacts.end(), contact, [](const Contact& i, const Contact& j) {
        return i.a.index != j.a.index ? i.a.index < j.a.index : i.b.index < j.b.index;
      });
  const bool same = found != contacts.end() && found->a.index == contact.a.index && found->b.index == contact.b.index;
  return same ? found->facet_pairs() : std::span<const FacetPair>();
}

}  // namespace

LostPairs::LostPairs(const Simulation& simulation, int threads)
    : exact_({.threads = threads, .accuracy = Accuracy::exact}) {
  for (std::size_t i = 0; i < simulation.bodies().size(); ++i) {
    const Body& body = simulation.bodies()[i];
    ids_.push_back(exact_.add_body({.positions = as_matrix(simulation.seen(i)),
                                    .facets = body.facets,
                                    .surface = body.surface,
                                    .motion = body.motion,
                                    .name = body.name}));
  }
}

void LostPairs::add_step(const Simulation& simulation) {
  std::vector<PositionsUpdate> updates;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (simulation.bodies()[i].motion == Motion::fixed) continue;
    updates.push_back({ids_[i], as_matrix(simulation.seen(i))});
  }
  exact_.set_positions(updates);
  std::vector<FacetPair> missing;
  for (const Contact& contact : exact_.detect().contacts()) {
    if (!contact.touching()) continue;
    const auto pairs = contact.facet_pairs();
    const auto seen = told(*simulation.report(), contact);
    missing.clear();
    std::set_difference(pairs.begin(), pairs.end(), seen.begin(), seen.end(), std::back_inserter(missing));
    all_ += static_cast<std::int64_t>(pairs.size());
    lost_ += static_cast<std::int64_t>(missing.size());
    ++contacts_;
    if (missing.size() == pairs.size()) ++lost_contacts_;
  }
}

void LostPairs::print(std::ostream& out) const {
  const auto share = [](std::int64_t part, std::int64_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  fmt::print(out, "facet pairs lost, against the exact answer: {} of {} ({:.1f} %); contacts that lost all: {} of {}\n",
             lost_, all_, share(lost_, all_), lost_contacts_, contacts_);
}

}  // namespace tact::scenes
