// Random calls of every kind, made by a world and by a twin that is built anew every now and then, with other threads:
// both answer the same bit for bit, whatever the world has been through before.
//   TACT_LONG_SEQUENCES  worlds, 10 if not set; TACT_LONG_SECONDS for as long instead; TACT_LONG_SEED
#include <gtest/gtest.h>

#include <string>

#include "engine/failed_step.h"
#include "engine/world_tuning.h"
#include "tests/support/checks/random_calls.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/environment/environment.h"

namespace tact::tests {
namespace {

constexpr int kTwins = 6;  // of a world, one after the other

class Life {
 public:
  explicit Life(std::uint64_t seed)
      : random_(seed),
        calls_(random_.bits()),
        tuning_(random_.chance(0.4)   ? base::kTuning
                : random_.chance(0.5) ? kPlain
                                      : kForced),
        subject_(calls_.settings(1 + random_.below(2))) {
    WorldTuning::set(subject_.world, tuning_);
  }

  // Some calls of the world alone, then a twin, then some of both. Returns what is wrong.
  std::string live_with_a_new_twin() {
    for (int i = random_.below(30); i >= 0; --i) {
      make(calls_.next(), subject_);
      answer_of(subject_);
    }
    // What the world remembers of earlier steps is forgotten, as the twin knows none.
    FailedStep::play(subject_.world);
    Subject twin(calls_.settings(1 + random_.below(2)));
    WorldTuning::set(twin.world, tuning_);
    calls_.build(twin);
    subject_.patches.clear();
    subject_.last_report = nullptr;
    subject_.report = &subject_.world.detect();
    twin.report = &twin.world.detect();
    if (const std::string wrong = compare(twin); !wrong.empty()) return "the first step: " + wrong;
    for (int i = random_.below(60); i >= 0; --i) {
      const Call call = calls_.next();
      make(call, subject_);
      make(call, twin);
      if (const std::string wrong = compare(twin); !wrong.empty()) return call.name + ": " + wrong;
    }
    return {};
  }

 private:
  static void make(const Call& call, Subject& subject) {
    call.prepare(subject);
    call.run(subject);
    call.note(subject);
  }

  std::string compare(Subject& twin) {
    subject_.leaves_out_ids = twin.leaves_out_ids = calls_.any_renamed();
    const AnswerHashes own = answer_of(subject_), of_twin = answer_of(twin);
    if (own.features != of_twin.features) return "another answer";
    if (own.numbers != of_twin.numbers) return "other numbers";
    if (!(state_of(subject_) == state_of(twin))) return "another world";
    return {};
  }

  Random random_;
  RandomCalls calls_;
  base::Tuning tuning_;
  Subject subject_;
};

TEST(CallSequencesLong, AnswerAsATwinThatIsBuiltAnew) {
  for_seeds_or_seconds("TACT_LONG_SEQUENCES", 10, [](std::uint64_t seed) {
    Life life(seed);
    for (int twin = 0; twin < kTwins; ++twin) {
      const std::string wrong = life.live_with_a_new_twin();
      EXPECT_EQ(wrong, "") << "seed " << seed << ", twin " << twin;
      if (!wrong.empty()) return false;
    }
    return true;
  });
}

}  // namespace
}  // namespace tact::tests
