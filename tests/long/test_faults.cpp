// Every allocation of every call of the interface fails, one after the other, in worlds that make random calls. What is
// thrown is the error of memory and no other; the world is as it was before; and a twin that makes the same calls, and
// whose steps fail where those of the world did, answers the same bit for bit ever after. So does a recording of it.
//   TACT_LONG_FAULT_LIVES  worlds, 3 if not set; TACT_LONG_SECONDS for as long instead; TACT_LONG_SEED
//   TACT_LONG_FAULTS_LEFT_OUT  0: none; 8 if not set: after n allocations that failed up to n / 8 are left out
#include <gtest/gtest.h>
#include <pthread.h>
#include <tact/recording.h>

#include <cstdio>
#include <new>
#include <sstream>
#include <string>

#include "engine/failed_step.h"
#include "engine/world_tuning.h"
#include "tests/support/checks/random_calls.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/environment/environment.h"

namespace tact::tests {
namespace {

constexpr int kCalls = 40;          // of a life
constexpr long kMostFailed = 4000;  // allocations of a call, one after the other

enum class Outcome { finished, failed_unnoticed, threw, wrong_error };

// With the allocation numbered `number` failing, and all after it if `for_good`.
Outcome run_short_of_memory(const Call& call, Subject& subject, long number, bool for_good) {
  fail_allocation(number, for_good);
  try {
    call.run(subject);
    return stop_failing() ? Outcome::failed_unnoticed : Outcome::finished;
  } catch (const Error& error) {
    const bool has_failed = stop_failing();
    return has_failed && error.code() == ErrorCode::out_of_memory ? Outcome::threw : Outcome::wrong_error;
  } catch (...) {
    stop_failing();
    return Outcome::wrong_error;
  }
}

// For each device that Embree fails to make for want of memory it keeps one of the 1,024 thread keys of the process
// (seen with 3.13.5). When they are used up no device can be made any more.
bool can_start_embree() {
  constexpr pthread_key_t kMost = 1000;
  pthread_key_t key = 0;
  if (pthread_key_create(&key, nullptr) != 0) return false;
  pthread_key_delete(key);
  return key < kMost;
}

class Life {
 public:
  explicit Life(std::uint64_t seed)
      : random_(seed),
        calls_(random_.bits()),
        subject_(calls_.settings(random_.chance(0.2) ? 2 : 1)),
        twin_(calls_.settings(1)) {
    if (random_.chance(0.5)) {
      WorldTuning::set(subject_.world, kForced);
      WorldTuning::set(twin_.world, kForced);
    }
    twin_.world.set_observer(&recorder_);
  }

  // A call, each of its allocations failing in turn. Returns what is wrong.
  std::string step() {
    const Call call = calls_.next();
    const bool for_good = random_.chance(0.2);
    const AnswerHashes before = state_of(subject_);
    bool done = false, failed_step = false;
    for (long number = random_.chance(0.7) ? 0 : random_.below(30); !done && number < kMostFailed;
         number += next_after(number)) {
      const std::string where = call.name + ", allocation " + std::to_string(number) + (for_good ? " and later" : "");
      call.prepare(subject_);
      const Outcome outcome = run_short_of_memory(call, subject_, number, for_good);
      if (outcome == Outcome::wrong_error) return where + ": another error than that of memory";
      done = outcome == Outcome::finished || (outcome == Outcome::failed_unnoticed && !call.changes_nothing);
      if (outcome != Outcome::threw) continue;
      if (!(state_of(subject_) == before)) return where + ": the world has changed";
      failed_step = failed_step || call.is_step;
      subject_.last_report = call.is_step ? nullptr : subject_.last_report;
      if (call.is_step && random_.chance(0.05)) break;  // and other calls come after it
    }
    if (failed_step) {
      FailedStep::play(twin_.world);
      twin_.last_report = nullptr;
    }
    if (done) return answer_as_twin(call);
    if (!call.is_step) return call.name + ": so many allocations";
    return {};
  }

  // Whether the recording of the twin plays.
  std::string replay() const {
    const std::string bytes = recording_.str();
    RecordingPlayer player(bytes);
    int steps = 0;
    for (; const auto played = player.next(); ++steps) {
      if (played->recorded && !played->same()) return "recorded step " + std::to_string(played->number);
    }
    return player.cut_at() ? "the recording is cut" : "";
  }

 private:
  long next_after(long number) {
    static const auto part = static_cast<long>(from_environment("TACT_LONG_FAULTS_LEFT_OUT", 8));
    return part == 0 ? 1 : 1 + random_.below(1 + static_cast<int>(number / part));
  }

  // No allocation fails any more, so nothing is refused for want of memory or of what it left behind.
  std::string answer_as_twin(const Call& call) {
    try {
      return same_answer(call);
    } catch (const Error& error) {
      return call.name + " of the twin: " + error.what();
    }
  }

  std::string same_answer(const Call& call) {
    call.prepare(twin_);
    call.run(twin_);
    call.note(subject_);
    call.note(twin_);
    if (!(answer_of(subject_) == answer_of(twin_))) return call.name + ": another answer";
    if (!(state_of(subject_) == state_of(twin_))) return call.name + ": another world";
    return {};
  }

  Random random_;
  RandomCalls calls_;
  std::ostringstream recording_;
  Recorder recorder_{recording_};
  Subject subject_, twin_;
};

TEST(Faults, OfEveryAllocationOfEveryCallLeaveAValidWorld) {
  for_seeds_or_seconds("TACT_LONG_FAULT_LIVES", 3, [](std::uint64_t seed) {
    if (!can_start_embree()) {
      std::printf("ends here: Embree has used up the thread keys of the process\n");
      return false;
    }
    Life life(seed);
    for (int call = 0; call < kCalls; ++call) {
      const std::string wrong = life.step();
      EXPECT_EQ(wrong, "") << "seed " << seed << ", call " << call;
      if (!wrong.empty()) return false;
    }
    const std::string wrong = life.replay();
    EXPECT_EQ(wrong, "") << "seed " << seed;
    return wrong.empty();
  });
}

}  // namespace
}  // namespace tact::tests
