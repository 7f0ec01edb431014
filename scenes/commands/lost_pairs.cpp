#include "scenes/commands/lost_pairs.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace tact::scenes {
namespace {

// The positions of a body moved out by twice its thickness.
std::vector<Vec3> thickened(const Body& body) {
  if (body.surface == Surface::sheet) return body.positions;
  std::vector<Vec3> positions(body.positions.size());
  for (Eigen::Index f = 0; f < body.facets.cols(); ++f) {
    const auto corner = [&](int k) { return body.positions[body.facets(k, f)]; };
    const Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    for (int k = 0; k < 3; ++k) {
      Vec3& sum = positions[body.facets(k, f)];
      sum = sum + normal;
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const double length = norm(positions[v]);
    positions[v] = body.positions[v] + (length > 0.0 ? 2.0 * body.thickness / length : 0.0) * positions[v];
  }
  return positions;
}

}  // namespace

LostPairs::LostPairs(const Simulation& simulation, int threads)
    : exact_({.threads = threads, .accuracy = Accuracy::exact}),
      paper_({.threads = threads, .accuracy = Accuracy::paper}) {
  show(simulation);
  for (std::size_t i = 0; i < simulation.bodies().size(); ++i) {
    const Body& body = simulation.bodies()[i];
    const BodyDefinition definition{.positions = as_matrix(seen_[i]),
                                    .facets = body.facets,
                                    .surface = body.surface,
                                    .motion = body.motion,
                                    .name = body.name};
    exact_ids_.push_back(exact_.add_body(definition));
    paper_ids_.push_back(paper_.add_body(definition));
  }
}

void LostPairs::show(const Simulation& simulation) {
  seen_.resize(simulation.bodies().size());
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Body& body = simulation.bodies()[i];
    if (body.motion != Motion::fixed || seen_[i].empty()) seen_[i] = thickened(body);
  }
}

void LostPairs::add_step(const Simulation& simulation) {
  show(simulation);
  std::vector<PositionsUpdate> exact_updates, paper_updates;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (simulation.bodies()[i].motion == Motion::fixed) continue;
    exact_updates.push_back({exact_ids_[i], as_matrix(seen_[i])});
    paper_updates.push_back({paper_ids_[i], as_matrix(seen_[i])});
  }
  exact_.set_positions(exact_updates);
  paper_.set_positions(paper_updates);
  exact_report_ = &exact_.detect();
  const Report& paper = paper_.detect();
  std::vector<FacetPair> missing;
  for (const Contact& contact : exact_report_->contacts()) {
    if (contact.facet_pairs().empty()) continue;
    const auto pairs = contact.facet_pairs();
    const Contact* told = paper.find_contact(paper_ids_[contact.a.index], paper_ids_[contact.b.index]);
    const auto seen = told != nullptr ? told->facet_pairs() : std::span<const FacetPair>();
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
