#include <tact/report.h>

#include <algorithm>
#include <span>
#include <utility>

#include "engine/base/hash.h"

namespace tact {

namespace {

using base::Hash;

void add(Hash& hash, const Eigen::Vector3d& v) {
  for (int axis = 0; axis < 3; ++axis) hash.add(v[axis]);
}

// Keys that are indices are one word.
void add_keys(Hash& hash, std::uint64_t a, std::uint64_t b) {
  hash.add(a << 32 | (b & 0xffffffffu));
  if ((a | b) >> 32 != 0) hash.add((a >> 32) << 32 | b >> 32);
}

// Of two indices, numbers of facets or vertices.
std::uint64_t word_of(int a, int b) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b);
}

// What a report's hash has of a contact besides its bodies.
void add_answers(Hash& hash, const Contact& contact) {
  add(hash, contact.direction);
  for (const double value :
       {contact.depth, contact.plane_a, contact.plane_b, contact.zone_a.radius, contact.zone_b.radius})
    hash.add(value);
  add(hash, contact.zone_a.center);
  add(hash, contact.zone_b.center);
  if (contact.containment != Containment::none) hash.add(static_cast<std::uint64_t>(contact.containment));
  for (const FacetPair pair : contact.facet_pairs()) hash.add(word_of(pair.a, pair.b));
  for (const ContactPoint& point : contact.points()) {
    hash.add(point.id);
    add(hash, point.normal);
    hash.add(point.gap);
    for (std::size_t k = 0; k < 3; ++k) {
      hash.add(point.a_weights[k]);
      hash.add(point.b_weights[k]);
    }
  }
  for (const ReachPair& pair : contact.within_reach()) {
    hash.add(static_cast<std::uint64_t>(pair.kind));
    hash.add(pair.distance);
    for (std::size_t k = 0; k < 3; ++k) {
      hash.add(word_of(pair.a_vertices[k], pair.b_vertices[k]));
      hash.add(pair.a_weights[k]);
      hash.add(pair.b_weights[k]);
      hash.add(pair.normal[k]);
    }
  }
}

void add_patch(Hash& hash, const Patch& patch) {
  hash.add(patch.id);
  add(hash, patch.point);
  add(hash, patch.direction);
  hash.add(patch.depth);
  hash.add(patch.area);
  hash.add(patch.facet_pairs.size());
  for (const std::span<const int> members : {patch.facet_pairs, patch.points, std::span<const int>(patch.spanning)}) {
    for (const int member : members) hash.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(member)));
  }
}

}  // namespace

std::uint64_t Contact::hash() const {
  Hash hash;
  add_keys(hash, key_a_, key_b_);
  hash.add(static_cast<std::uint64_t>(source) << 2 | (limit_reached ? 2u : 0u) | (touching_ ? 1u : 0u));
  add_answers(hash, *this);
  for (const Patch& patch : patches_) add_patch(hash, patch);
  return hash.value();
}

const Contact* Report::find_contact(BodyId a, BodyId b) const noexcept {
  if (key(b) < key(a)) std::swap(a, b);
  const auto keys = [](const Contact& contact) { return std::pair(contact.key_a_, contact.key_b_); };
  const auto found = std::ranges::lower_bound(contacts_, std::pair(key(a), key(b)), {}, keys);
  return found != contacts_.end() && found->a == a && found->b == b ? &*found : nullptr;
}

std::uint64_t Report::hash() const {
  Hash hash;
  for (const CandidatePair& pair : candidate_pairs_) {
    add_keys(hash, key(pair.a), key(pair.b));
    hash.add(std::uint64_t{pair.hulls_overlap});
  }
  for (const Contact& contact : contacts_) {
    add_keys(hash, contact.key_a_, contact.key_b_);
    add_answers(hash, contact);
  }
  return hash.value();
}

}  // namespace tact
