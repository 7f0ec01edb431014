#include "engine/renumbering.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace tact {

namespace {

using Feature = std::array<int, 3>;  // as in ContactPoint

// An edge or a facet whose vertices were split in four each has so many heirs; of more the vertices are taken side by
// side.
constexpr std::size_t kMostHeirs = 64;

std::size_t size_of(const Feature& feature) { return static_cast<std::size_t>(3 - std::ranges::count(feature, -1)); }

Feature made_of(std::span<const int> vertices) {
  Feature feature{-1, -1, -1};
  std::ranges::copy(vertices, feature.begin());
  if (vertices.size() == 2 && feature[1] < feature[0]) std::swap(feature[0], feature[1]);
  return feature;
}

// The heir of a feature each of whose vertices has one.
bool only_heir(const Feature& feature, const Bodies::VertexChange& change, Feature& heir) {
  heir = {-1, -1, -1};
  std::size_t count = 0;
  for (; count < 3 && feature[count] >= 0; ++count) {
    const std::span<const int> heirs = change.heirs_of(feature[count]);
    if (heirs.size() != 1) return false;
    heir[count] = heirs[0];
  }
  if (count == 2 && heir[1] < heir[0]) std::swap(heir[0], heir[1]);
  return true;
}

// Which features one is now that was on the body. A facet some of whose vertices are gone is what is left of it.
std::vector<Feature> heirs_of(const Feature& feature, bool is_facet, const Bodies::VertexChange& change) {
  std::vector<std::span<const int>> of_vertex;
  std::size_t all = 1, most = 0;
  for (const int v : std::span(feature).first(size_of(feature))) {
    const std::span<const int> heirs = change.heirs_of(v);
    if (heirs.empty() && !is_facet) return {};
    if (heirs.empty()) continue;
    of_vertex.push_back(heirs);
    all = std::min(all * heirs.size(), kMostHeirs + 1);
    most = std::max(most, heirs.size());
  }
  std::vector<Feature> found;
  std::array<int, 3> vertices{};
  const bool side_by_side = all > kMostHeirs;
  for (std::size_t i = 0; i < (side_by_side ? most : all); ++i) {
    std::size_t rest = i;
    for (std::size_t k = 0; k < of_vertex.size(); ++k) {
      const std::size_t size = of_vertex[k].size();
      vertices[k] = of_vertex[k][side_by_side ? std::min(i, size - 1) : rest % size];
      rest /= size;
    }
    found.push_back(made_of(std::span(vertices).first(of_vertex.size())));
  }
  return found;
}

}  // namespace

void Renumbering::add_points(const std::vector<ContactPoint>& points, Sides sides,
                             std::vector<ContactPoint>& to) const {
  const auto add = [&](const ContactPoint& point, const Feature& a, const Feature& b) {
    ContactPoint& added = to.emplace_back(point);
    added.a_vertices = a;
    added.b_vertices = b;
    const bool is_symmetric = point.kind == FeaturePair::edge_edge || point.kind == FeaturePair::vertex_vertex;
    if (!(sides.a && sides.b && is_symmetric && b < a)) return;
    std::swap(added.a_vertices, added.b_vertices);
    std::swap(added.a_weights, added.b_weights);
    added.normal = -added.normal;
  };
  to.reserve(points.size());
  for (const ContactPoint& point : points) {
    Feature heir_a = point.a_vertices, heir_b = point.b_vertices;
    if ((!sides.a || only_heir(point.a_vertices, change_, heir_a)) &&
        (!sides.b || only_heir(point.b_vertices, change_, heir_b))) {
      add(point, heir_a, heir_b);
      continue;
    }
    const bool facet_of_a = point.kind == FeaturePair::facet_vertex,
               facet_of_b = point.kind == FeaturePair::vertex_facet;
    const std::vector<Feature> of_a = sides.a ? heirs_of(point.a_vertices, facet_of_a, change_)
                                              : std::vector<Feature>{point.a_vertices},
                               of_b = sides.b ? heirs_of(point.b_vertices, facet_of_b, change_)
                                              : std::vector<Feature>{point.b_vertices};
    for (const Feature& a : of_a) {
      for (const Feature& b : of_b) add(point, a, b);
    }
  }
}

void Renumbering::add_vertices(const PatchSet& patches, Sides sides, std::vector<PatchVertex>& to) const {
  const bool of_one = sides.a && sides.b;
  for (const PatchVertex& one : patches.vertices) {
    const bool of_b = one.vertex % 2 != 0;
    if (!of_one && !(of_b ? sides.b : sides.a)) {
      to.push_back(one);
      continue;
    }
    for (const int heir : change_.heirs_of(static_cast<int>(one.vertex / 2)))
      to.push_back({2 * std::int64_t{heir} + one.vertex % 2, one.patch});
  }
  std::ranges::sort(to);
}

// In the memory of the step before, which no one reads between steps: new memory of many points takes as long as they
// do.
template <class Record>
std::vector<ContactPoint> Renumbering::renumbered(Record& record, Sides sides) const {
  std::vector<ContactPoint> made;
  if (!record.is_renumbered) made.swap(record.last_points);
  made.clear();
  add_points(record.is_renumbered ? record.last_points : record.points, sides, made);
  return made;
}

void Renumbering::add(PairRecord& record) {
  const Sides sides{record.a == change_.id, record.b == change_.id};
  OfRecord& made = records_.emplace_back();
  made.pair = &record;
  if (in_contact(record)) made.points = renumbered(record, sides);
  if (record.patches != nullptr) add_vertices(record.patches->now, sides, made.vertices);
}

void Renumbering::add(SelfRecord& record) {
  OfRecord& made = records_.emplace_back();
  made.self = &record;
  made.points = renumbered(record, {true, true});
  add_vertices(record.patches.now, {true, true}, made.vertices);
}

void Renumbering::publish() noexcept {
  for (OfRecord& made : records_) {
    if (made.pair != nullptr) {
      made.pair->last_points.swap(made.points);
      made.pair->is_renumbered = in_contact(*made.pair);
      if (made.pair->patches != nullptr) made.pair->patches->now.vertices.swap(made.vertices);
    } else {
      made.self->last_points.swap(made.points);
      made.self->is_renumbered = true;
      made.self->patches.now.vertices.swap(made.vertices);
      made.self->crossing.reset();
    }
  }
}

}  // namespace tact
