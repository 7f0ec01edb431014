// What became of every facet of a contact, and how facets are grouped: for people who look, such as with `tact view`,
// and for tests. No part of the package: its header is not installed.
//
// The engine keeps nothing for it. What the last step did is done once more with the engine's own criteria, so a report
// can be asked until bodies are added, removed or set.
#pragma once

#include <tact/report.h>

#include <memory>
#include <optional>
#include <vector>

#include "engine/base/facet_outcome.h"

namespace tact {

class TACT_API FacetOutcomeFinder {
 public:
  // `report` is one of World::detect(), and outlives the finder.
  explicit FacetOutcomeFinder(const Report& report);
  ~FacetOutcomeFinder();

  // Of a contact of the report; nothing at Accuracy::hulls, where the hulls are apart, and of a body with itself. Kept
  // and meeting facets are as many as Contact::kept_facets_a and kept_facets_b tell, except of surfaces that lie on
  // each other where zones are not asked for: what a step remembers of them is not asked again, and more are kept.
  // Errors: out_of_memory, backend_failure.
  std::optional<FacetOutcomes> find(const Contact& contact);
  // The cluster of each facet of a body, counted from 0, as the last step grouped them. Errors: stale_body,
  // foreign_body.
  std::vector<int> clusters(BodyId body) const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace tact
