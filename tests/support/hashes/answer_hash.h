// Two numbers made from all that the public interface answers. Which features, bodies, ids, kinds, counts and signs of
// gaps: a change of rounding leaves these as they are. And all doubles bit by bit, with the choices that follow from
// comparing them. What a step did to find an answer is in neither: work_hash.h is of that.
#pragma once

#include <tact/motion.h>
#include <tact/queries.h>
#include <tact/report.h>

#include <bit>
#include <cstdint>
#include <map>
#include <ostream>
#include <span>

namespace tact::tests {

// A hash of 64-bit words in their order, with the finisher of SplitMix64 (Steele, Lea, Flood, 2014) on every word.
class WordHash {
 public:
  void add(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    state_ = std::rotl(state_ ^ word ^ (word >> 31), 23) * 0x9e3779b97f4a7c15u;
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3u;
};

struct AnswerHashes {
  std::uint64_t features = 0;
  std::uint64_t numbers = 0;
  friend bool operator==(const AnswerHashes&, const AnswerHashes&) = default;
};

class AnswerHash {
 public:
  void add(const Report& report);
  void add(const MotionReport& report);
  void add(const RayHit& hit);
  void add(const ClosestPoint& closest);
  void add(std::span<const RayHit> hits);
  void add(std::span<const ClosestPoint> closest);
  void add(std::span<const FacetOfBody> facets);
  void add(std::span<const BodyId> bodies);
  // Positions, say.
  void add(std::span<const double> numbers);
  // An answer that is no number: whether a ray of RayHits::any hits, say.
  void add_feature(std::uint64_t feature) { features_.add(feature); }

  // Patches are told apart by the order in which they were first seen, which `numbers` keeps from step to step: their
  // ids tell in which step they began, and those of a step are sorted by them.
  using PatchNumbers = std::map<std::uint64_t, std::uint64_t>;
  void number_patches(PatchNumbers& numbers) { patch_numbers_ = &numbers; }

  // Of points: they tell how often facets of a body have changed.
  void leave_out_ids() { leaves_out_ids_ = true; }

  AnswerHashes hashes() const { return {features_.value(), numbers_.value()}; }

 private:
  // Numbers of worlds differ from run to run, so they are left out.
  void add(BodyId body) { features_.add(std::uint64_t{body.generation} << 32 | body.index); }
  void add(double number) { numbers_.add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Eigen::Vector3d& v);
  void add_signed(double number);
  void add_vertices(std::span<const int> vertices);
  void add(const Contact& contact);
  void add(const ContactPoint& point);
  void add(const Patch& patch);
  void add_curves(const Contact& contact);
  void add(std::span<const PatchEvent> events);
  std::uint64_t name_of(std::uint64_t patch) const;

  WordHash features_, numbers_;
  PatchNumbers* patch_numbers_ = nullptr;
  bool leaves_out_ids_ = false;
};

}  // namespace tact::tests
