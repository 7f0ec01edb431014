#include "tests/support/checks/recorded_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <fstream>
#include <mutex>

namespace tact::tests {
namespace {

using Recording = std::shared_ptr<std::ostringstream>;

constexpr std::streamoff kLongest = 64'000'000;  // bytes
constexpr std::size_t kWorlds = 3;               // that are written for a failure

std::string name_of(const ::testing::TestInfo* test) {
  std::string name = test ? std::string(test->test_suite_name()) + "." + test->name() : "outside_of_tests";
  std::ranges::replace(name, '/', '_');
  return name;
}

// The worlds of the running test that made its last steps, the latest first.
class LatestWorlds : public ::testing::EmptyTestEventListener {
 public:
  static LatestWorlds& instance() {
    static LatestWorlds* const listener = [] {
      auto* made = new LatestWorlds;  // gtest deletes it
      made->name_ = name_of(::testing::UnitTest::GetInstance()->current_test_info());
      ::testing::UnitTest::GetInstance()->listeners().Append(made);
      return made;
    }();
    return *listener;
  }

  void note(const Recording& recording) {
    const std::lock_guard lock(mutex_);
    if (!latest_.empty() && latest_.front() == recording) return;
    std::erase(latest_, recording);
    latest_.push_front(recording);
    if (latest_.size() > kWorlds) latest_.pop_back();
  }

  std::vector<std::filesystem::path> write(const std::filesystem::path& folder) {
    const std::lock_guard lock(mutex_);
    std::filesystem::create_directories(folder);
    std::vector<std::filesystem::path> paths;
    for (const Recording& recording : latest_) {
      const std::string bytes = recording->str();
      if (bytes.empty()) continue;
      paths.push_back(folder / (name_ + "-" + std::to_string(paths.size() + 1) + ".tactrec"));
      std::ofstream(paths.back(), std::ios::binary) << bytes;
    }
    return paths;
  }

 private:
  void OnTestStart(const ::testing::TestInfo& test) override {
    forget();
    name_ = name_of(&test);  // gtest can be asked for it everywhere but in OnTestPartResult
  }
  void OnTestEnd(const ::testing::TestInfo&) override { forget(); }

  void OnTestPartResult(const ::testing::TestPartResult& result) override {
    if (!result.failed() || written_) return;
    written_ = true;
    for (const std::filesystem::path& path : write(std::filesystem::path(TACT_BINARY_DIR) / "failed_tests")) {
      std::printf("recorded; to run it again: tact replay %s\n", path.string().c_str());
    }
    std::fflush(stdout);
  }

  void forget() {
    const std::lock_guard lock(mutex_);
    latest_.clear();
    written_ = false;
  }

  std::mutex mutex_;
  std::deque<Recording> latest_;
  std::string name_;  // of the running test
  bool written_ = false;
};

}  // namespace

RecordedWorld::RecordedWorld(const Settings& settings)
    : World(settings),
      recording_(std::make_shared<std::ostringstream>()),
      recorder_(std::make_unique<Recorder>(*recording_)) {
  set_observer(recorder_.get());
  LatestWorlds::instance().note(recording_);
}

const Report& RecordedWorld::detect() {
  LatestWorlds::instance().note(recording_);
  if (recording_->tellp() > kLongest) {  // longer than a file for looking at a failure should be
    recording_->str({});
    recording_->setstate(std::ios::badbit);  // nothing more is written
  }
  return World::detect();
}

std::vector<std::filesystem::path> write_recordings(const std::filesystem::path& folder) {
  return LatestWorlds::instance().write(folder);
}

}  // namespace tact::tests
