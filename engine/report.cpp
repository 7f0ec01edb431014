#include <tact/report.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace tact {

namespace {

// A hash of 64-bit words: multiply and rotate, with the finisher of SplitMix64 (Steele, Lea, Flood, 2014) on every
// word.
class Hash {
 public:
  void add(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    state_ = std::rotl(state_ ^ word ^ (word >> 31), 23) * 0x9e3779b97f4a7c15u;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Eigen::Vector3d& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis]);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3u;
};

}  // namespace

const Contact* Report::find_contact(BodyId a, BodyId b) const noexcept {
  if (b < a) std::swap(a, b);
  const std::pair wanted(a, b);
  const auto bodies = [](const Contact& contact) { return std::pair(contact.a, contact.b); };
  const auto found = std::ranges::lower_bound(contacts_, wanted, {}, bodies);
  return found != contacts_.end() && bodies(*found) == wanted ? &*found : nullptr;
}

std::uint64_t Report::hash() const {
  Hash hash;
  for (const CandidatePair& pair : candidate_pairs_) {
    hash.add(std::uint64_t{pair.a.index} << 32 | pair.b.index);
    hash.add(std::uint64_t{pair.hulls_overlap});
  }
  for (const Contact& contact : contacts_) {
    hash.add(std::uint64_t{contact.a.index} << 32 | contact.b.index);
    hash.add(contact.direction);
    for (const double value :
         {contact.depth, contact.plane_a, contact.plane_b, contact.zone_a.radius, contact.zone_b.radius})
      hash.add(value);
    hash.add(contact.zone_a.center);
    hash.add(contact.zone_b.center);
    if (contact.containment != Containment::none) hash.add(static_cast<std::uint64_t>(contact.containment));
    for (const FacetPair pair : contact.facet_pairs()) {
      hash.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(pair.a)) << 32 |
               static_cast<std::uint32_t>(pair.b));
    }
    for (const ContactPoint& point : contact.points()) {
      hash.add(point.id);
      hash.add(point.normal);
      hash.add(point.gap);
      for (std::size_t k = 0; k < 3; ++k) {
        hash.add(point.a_weights[k]);
        hash.add(point.b_weights[k]);
      }
    }
  }
  return hash.value();
}

}  // namespace tact
