// What pairs and bodies with themselves remember of the last step, where the facets of a body change: the same by the
// new numbers of its vertices. It is made before anything changes, then takes its place.
#pragma once

#include <tact/contact_point.h>

#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_record.h"
#include "engine/self_record.h"

namespace tact {

class Renumbering {
 public:
  explicit Renumbering(const Bodies::VertexChange& change) : change_(change) {}

  // Of a record that names the body.
  void add(PairRecord& record);
  void add(SelfRecord& record);
  // Allocates nothing.
  void publish() noexcept;

 private:
  struct Sides {
    bool a, b;  // which side of a point is the body
  };
  struct OfRecord {
    PairRecord* pair = nullptr;  // one of both
    SelfRecord* self = nullptr;
    std::vector<ContactPoint> points;
    std::vector<PatchVertex> vertices;
  };
  template <class Record>
  std::vector<ContactPoint> renumbered(Record& record, Sides sides) const;
  void add_points(const std::vector<ContactPoint>& points, Sides sides, std::vector<ContactPoint>& to) const;
  void add_vertices(const PatchSet& patches, Sides sides, std::vector<PatchVertex>& to) const;

  const Bodies::VertexChange& change_;
  std::vector<OfRecord> records_;
};

}  // namespace tact
