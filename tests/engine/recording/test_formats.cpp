// Recordings and saved states as versions wrote them. tests/engine/recording/formats/README.md tells what made the
// files; they are never made anew.
#include <gtest/gtest.h>
#include <tact/recording.h>
#include <tact/tact.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/support/environment/temporary_folder.h"

namespace tact::tests {
namespace {

std::string bytes_of(const std::string& name) {
  return contents(TACT_SOURCE_DIR "/tests/engine/recording/formats/" + name);
}

class RecordingFormats : public testing::TestWithParam<int> {
 protected:
  int format() const { return GetParam(); }
  std::string bytes() const { return bytes_of("recording_" + std::to_string(format()) + ".tactrec"); }
};

TEST_P(RecordingFormats, HoldWhatTheyWereMadeOf) {
  const std::string file = bytes();
  ASSERT_GT(file.size(), 9u);
  EXPECT_EQ(file[8], format());
}

// Seven steps, in which every kind of call that the format has was made.
TEST_P(RecordingFormats, Play) {
  RecordingPlayer player(bytes());
  EXPECT_EQ(player.recorded_by(), "0.1.0");
  std::vector<PlayedStep> steps;
  while (const std::optional<PlayedStep> step = player.next()) {
    steps.push_back(*step);
    const World& world = player.world();
    const BodyId first = world.bodies()[0];
    EXPECT_EQ(world.margin(first), steps.size() < 2 ? 0.0 : 0.02);
    EXPECT_EQ(world.motion(first), steps.size() < 5 ? Motion::fixed : Motion::deformable);
    EXPECT_EQ(world.settings().outputs.points, steps.size() > 2);
    EXPECT_EQ(world.settings().outputs.curves, steps.size() > 2 && format() >= 7);
    EXPECT_EQ(world.group(first), steps.size() == 4 && format() >= 4 ? 9u : 0u);
  }
  EXPECT_FALSE(player.cut_at());
  ASSERT_EQ(steps.size(), 7u);
  for (const PlayedStep& step : steps) EXPECT_TRUE(step.recorded);
  EXPECT_TRUE(steps[0].same());  // nothing touches
  const World& world = player.world();
  EXPECT_EQ(world.bodies().size(), format() >= 7 ? 6u : format() == 6 ? 4u : format() == 5 ? 3u : 2u);
  EXPECT_EQ(world.name(world.bodies()[1]), "b");
  EXPECT_EQ(world.external_id(world.bodies()[1]), format() >= 4 ? 77u : 0u);
  const FeatureSettings settings = world.feature_settings(world.bodies()[1]);
  EXPECT_EQ(settings.vertex_labels.size(), format() >= 7 ? 4u : 0u);
  EXPECT_EQ(settings.facet_layers.size(), format() >= 8 ? 4u : 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RecordingFormats, testing::Range(3, 9));

TEST(StateFormats, TheOneOfThisVersionIsRestored) {
  const std::string file = bytes_of("state_4.tactstate");
  World world;
  world.restore(std::as_bytes(std::span(file)));
  EXPECT_EQ(world.body_count(), 6u);
  EXPECT_EQ(world.feature_settings(world.bodies()[1]).facet_layers.size(), 4u);
  world.detect();
}

}  // namespace
}  // namespace tact::tests
