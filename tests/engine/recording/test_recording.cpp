#include <gtest/gtest.h>
#include <tact/recording.h>
#include <tact/tact.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace tact::tests {
namespace {

template <class Number>
std::string bytes_of(Number value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// A world that is recorded, and its recording.
struct Recorded {
  std::ostringstream out;
  Recorder recorder{out};
  World world;
  explicit Recorded(int threads) : world({.threads = threads}) { world.set_observer(&recorder); }
};

// A tetrahedron with its right angle at `corner`, facets outward.
Eigen::Matrix3Xd tetrahedron_at(const Eigen::Vector3d& corner) {
  Eigen::Matrix3Xd positions(3, 4);
  positions << Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity();
  return positions.colwise() + corner;
}

Eigen::Matrix3Xi tetrahedron_facets() {
  Eigen::Matrix3Xi facets(3, 4);
  facets << 0, 0, 0, 1,  //
      2, 1, 3, 2,        //
      1, 3, 2, 3;
  return facets;
}

// Every kind of call: a is fixed until the last step, b comes in and turns, c goes and d takes its place, e meets only
// what is on its layer, and for a step nothing. Returns the hashes of the steps.
std::vector<std::uint64_t> make_calls(World& world) {
  const Eigen::Matrix3Xi facets = tetrahedron_facets();
  const auto add = [&](const Eigen::Vector3d& corner, Motion motion, std::uint32_t mask) {
    const Eigen::Matrix3Xd positions = tetrahedron_at(corner);
    return world.add_body({.positions = positions,
                           .facets = facets,
                           .surface = mask == 2 ? Surface::sheet : Surface::closed,
                           .motion = motion,
                           .name = "body of mask " + std::to_string(mask),
                           .layer = mask == 2 ? 3u : 1u,
                           .mask = mask});
  };
  const BodyId a = add({0, 0, 0}, Motion::fixed, ~0u);
  const BodyId b = add({2, 0.1, 0.1}, Motion::deformable, ~0u);
  const BodyId c = add({0.1, 0.2, 0.1}, Motion::deformable, ~0u);
  const BodyId e = add({0.2, 0.1, 0.1}, Motion::deformable, 2u);
  std::vector<std::uint64_t> hashes;
  for (int step = 0; step < 6; ++step) {
    // Columns that do not follow each other in memory.
    Eigen::Matrix<double, 4, Eigen::Dynamic> wide(4, 4);
    wide.topRows(3) = tetrahedron_at({1.0 - 0.15 * step, 0.1, 0.1 + 0.01 * step});
    const Eigen::Matrix3Xd other = tetrahedron_at({0.2, 0.1 * step, 0.1});
    const std::vector<PositionsUpdate> updates = {{b, wide.topRows(3)}, {e, other}};
    world.set_positions(updates);
    if (step == 3) {
      world.remove_body(c);
      add({0.05, 0.05, 0.3}, Motion::deformable, ~0u);
      world.set_settings({.threads = 1, .accuracy = Accuracy::paper, .outputs = {.zones = true, .patches = true}});
    }
    if (step == 4) world.set_layers(e, 3u, 0u);
    if (step == 5) {
      world.set_layers(e, 3u, 2u);
      world.set_motion(a, Motion::deformable);
    }
    hashes.push_back(world.detect().hash());
  }
  return hashes;
}

std::string recording() {
  Recorded recorded(2);
  make_calls(recorded.world);
  return recorded.out.str();
}

std::vector<PlayedStep> play(std::string_view bytes, std::optional<int> threads = 1) {
  RecordingPlayer player(bytes, {.threads = threads, .outputs = {}});
  std::vector<PlayedStep> steps;
  while (const auto step = player.next()) steps.push_back(*step);
  return steps;
}

// What the player says against `bytes`; "accepted" if it says nothing.
std::string recording_refusal(std::string_view bytes) {
  try {
    play(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

bool all_same(const std::vector<PlayedStep>& steps) {
  return std::all_of(steps.begin(), steps.end(), [](const PlayedStep& step) { return step.same(); });
}

std::string with(std::string bytes, std::size_t at, std::string_view change) {
  return bytes.replace(at, change.size(), change);
}

constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kSettingsAt = 12 + 4 + std::string_view(TACT_VERSION).size();
constexpr std::size_t kFirstBodyAt = kSettingsAt + 21;
constexpr std::size_t kExternalIdAt = kFirstBodyAt + 11;
constexpr std::size_t kVerticesAt = kFirstBodyAt + 19 + 4 + std::string_view("body of mask 4294967295").size();

std::string at_byte(std::size_t byte) { return "byte " + std::to_string(byte) + ": "; }

TEST(Recording, AnyNumberOfThreadsPlaysTheSameHashes) {
  Recorded recorded(2);
  const std::vector<std::uint64_t> hashes = make_calls(recorded.world);
  World silent({.threads = 1});
  EXPECT_EQ(make_calls(silent), hashes);
  EXPECT_NE(hashes.front(), hashes.back());
  for (const std::optional<int> threads : {std::optional<int>(), std::optional(1), std::optional(2)}) {
    const std::vector<PlayedStep> steps = play(recorded.out.str(), threads);
    ASSERT_EQ(steps.size(), hashes.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(steps[i].number, static_cast<int>(i));
      EXPECT_EQ(steps[i].recorded, hashes[i]);
      EXPECT_EQ(steps[i].now, hashes[i]);
    }
  }
}

TEST(Recording, WrongNumbersOfThreadsAreNoFaultOfTheRecording) {
  Recorded recorded(1);
  make_calls(recorded.world);
  for (const int threads : {-5, 1025}) {
    try {
      play(recorded.out.str(), threads);
      ADD_FAILURE() << threads;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
      EXPECT_EQ(std::string(error.what()), "threads is " + std::to_string(threads) + ", not 0 to 1024");
    }
  }
}

TEST(Recording, PlaysTheBodiesAsTheyWere) {
  const std::string bytes = recording();
  RecordingPlayer player(bytes);
  EXPECT_EQ(player.recorded_by(), TACT_VERSION);
  EXPECT_EQ(player.world().settings().threads, 2);
  ASSERT_TRUE(player.next());
  const std::vector<BodyId> bodies = player.world().bodies();
  ASSERT_EQ(bodies.size(), 4u);
  EXPECT_EQ(player.world().name(bodies[3]), "body of mask 2");
  EXPECT_EQ(player.world().surface(bodies[3]), Surface::sheet);
  EXPECT_EQ(player.world().motion(bodies[0]), Motion::fixed);
  while (player.next()) continue;
  EXPECT_EQ(player.world().settings().accuracy, Accuracy::paper);
  EXPECT_TRUE(player.world().settings().outputs.patches);
  EXPECT_FALSE(player.world().contains(bodies[2]));
  EXPECT_EQ(player.world().motion(bodies[0]), Motion::deformable);
  EXPECT_EQ(player.world().mask(bodies[3]), 2u);
}

// A view of what a body has, changed and set again: what it views is gone when the observer is told.
TEST(Recording, SettingsReadFromTheWorldAndSetAgainAreRecorded) {
  Recorded recorded(1);
  World& world = recorded.world;
  const Eigen::Matrix3Xd positions = tetrahedron_at({0, 0, 0});
  const Eigen::Matrix3Xi facets = tetrahedron_facets();
  const BodyId body = world.add_body({.positions = positions, .facets = facets});
  const std::vector<double> offsets = {0.1, 0.2, 0.3, 0.4};
  const std::vector<std::uint32_t> labels = {5, 6, 7, 8};
  world.set_margin(body, 0.5);
  world.set_feature_settings(body, {.rest_offsets = offsets});
  world.set_self_contact_filter(body, {.rest_distance = 0.1});
  FeatureSettings settings = world.feature_settings(body);
  settings.vertex_labels = labels;
  world.set_feature_settings(body, settings);
  SelfContactFilter filter = world.self_contact_filter(body);
  filter.rings = 1;
  world.set_self_contact_filter(body, filter);
  world.detect();
  RecordingPlayer player(recorded.out.str());
  while (player.next()) continue;
  const BodyId played = player.world().bodies().at(0);
  EXPECT_TRUE(std::ranges::equal(player.world().feature_settings(played).rest_offsets, offsets));
  EXPECT_TRUE(std::ranges::equal(player.world().feature_settings(played).vertex_labels, labels));
  const SelfContactFilter now = player.world().self_contact_filter(played);
  EXPECT_EQ(now.rings, 1);
  ASSERT_EQ(now.rest_positions.cols(), 4);
  for (int v = 0; v < 4; ++v)
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(now.rest_positions.column(v)[axis], positions(axis, v));
}

TEST(Recording, RefusedCallsAreNotRecorded) {
  Recorded recorded(1);
  World& world = recorded.world;
  const Eigen::Matrix3Xd positions = tetrahedron_at({0, 0, 0});
  const Eigen::Matrix3Xi facets = Eigen::Matrix3Xi::Constant(3, 1, 4);
  EXPECT_THROW(world.add_body({.positions = positions, .facets = facets}), Error);
  EXPECT_THROW(world.remove_body({.index = 0, .generation = 1, .world = 1}), Error);
  world.detect();
  EXPECT_TRUE(all_same(play(recorded.out.str())));
}

TEST(Recording, ChangedHashIsFoundAtItsByte) {
  std::string bytes = recording();
  const std::size_t at = bytes.size() - 8;
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  const std::vector<PlayedStep> steps = play(bytes);
  ASSERT_EQ(steps.size(), 6u);
  EXPECT_FALSE(steps.back().same());
  EXPECT_EQ(steps.back().byte, at);
  EXPECT_TRUE(all_same({steps.begin(), steps.end() - 1}));
}

TEST(Recording, SaysWhatIsWrongAndAtWhichByte) {
  const std::string good = recording();
  ASSERT_EQ(recording_refusal(good), "accepted");
  EXPECT_EQ(recording_refusal(""), "byte 0: not a recording: it does not begin with tactrec");
  EXPECT_EQ(recording_refusal("solid a"), "byte 0: not a recording: it does not begin with tactrec");
  EXPECT_EQ(recording_refusal(with(good, kVersionAt, bytes_of(9u))),
            "byte 8: a recording of version 9; versions 1 to 8 can be read");
  EXPECT_EQ(recording_refusal(with(good, kVersionAt, bytes_of(0u))),
            "byte 8: a recording of version 0; versions 1 to 8 can be read");
  EXPECT_EQ(recording_refusal(with(good, kSettingsAt, "\x02")),
            at_byte(kSettingsAt) + "the first record is not one of settings");
  EXPECT_EQ(recording_refusal(with(good, kFirstBodyAt, "\x7f")),
            at_byte(kFirstBodyAt) + "step 0: no record is of kind 127");
  EXPECT_EQ(recording_refusal(with(good, kFirstBodyAt, "\x0f")),
            at_byte(kFirstBodyAt) + "step 0: a failure that follows no step");
  EXPECT_EQ(recording_refusal(with(good, kVerticesAt + 16, bytes_of(std::numeric_limits<double>::quiet_NaN())))
                .substr(0, at_byte(kFirstBodyAt).size()),
            at_byte(kFirstBodyAt));
}

// Cut anywhere behind the settings, what is whole plays, and only between records is nothing said to be cut.
TEST(Recording, CutAnywherePlaysWhatIsWhole) {
  const std::string good = recording();
  const std::size_t whole_steps = play(good).size();
  int between_records = 0;
  for (std::size_t size = kFirstBodyAt; size < good.size(); ++size) {
    RecordingPlayer player(std::string_view(good).substr(0, size), {.threads = 1, .outputs = {}});
    std::vector<PlayedStep> steps;
    while (const auto step = player.next()) {
      if (step->recorded) steps.push_back(*step);
    }
    EXPECT_TRUE(all_same(steps)) << "cut at byte " << size;
    EXPECT_LT(steps.size(), whole_steps);
    if (!player.cut_at()) ++between_records;
    EXPECT_LE(player.cut_at().value_or(0), size);
  }
  // Behind the settings, 5 additions, 6 moves, 1 removal, 1 change of settings, 2 of layers, 1 of motion, 6 detects and
  // 6 hashes, of which the last is the whole file.
  EXPECT_EQ(between_records, 1 + 5 + 6 + 1 + 1 + 2 + 1 + 6 + 6 - 1);
}

TEST(Recording, CutInItsHeadIsRefused) {
  const std::string good = recording();
  for (std::size_t size = 8; size < kFirstBodyAt; ++size) {
    EXPECT_NE(recording_refusal(std::string_view(good).substr(0, size)).find("ends in its head"), std::string::npos)
        << size;
  }
}

// A count that no recording could hold takes no memory: it reads as one that was cut.
TEST(Recording, PromisesAreNotBelieved) {
  const std::string bytes = with(recording(), kVerticesAt, bytes_of(~std::uint64_t{0}));
  RecordingPlayer player(bytes, {.threads = 1, .outputs = {}});
  EXPECT_FALSE(player.next());
  EXPECT_EQ(player.cut_at(), kFirstBodyAt);
}

// With any bit of the head and the first body wrong, or one of each byte after them, the player ends: it refuses the
// file or plays it.
TEST(Recording, AnyBitWrong) {
  const std::string good = recording();
  for (std::size_t bit = 0; bit < 8 * good.size(); bit += bit < 8 * 256 ? 1 : 7) {
    std::string bytes = good;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    const std::string message = recording_refusal(bytes);
    EXPECT_TRUE(message == "accepted" || message.starts_with("byte ")) << "bit " << bit << ": " << message;
    const auto version = static_cast<unsigned char>(bytes[kVersionAt]);
    const bool in_magic = bit < 8 * kVersionAt, in_version = !in_magic && bit < 8 * (kVersionAt + 4);
    const bool is_known = bit < 8 * (kVersionAt + 1) && version >= 1 && version <= 8;  // an older one, read as such
    EXPECT_FALSE((in_magic || (in_version && !is_known)) && message == "accepted") << "bit " << bit;
  }
}

// The step that a program died in is run, as it is what one wants to see.
TEST(Recording, StepWithoutAnAnswerIsPlayed) {
  const std::string good = recording();
  const std::vector<PlayedStep> steps = play(std::string_view(good).substr(0, good.size() - 9));
  ASSERT_EQ(steps.size(), 6u);
  EXPECT_FALSE(steps.back().recorded);
  EXPECT_EQ(steps.back().now, play(good).back().now);
}

// Version 3 kept no external id.
TEST(Recording, OlderVersionIsRead) {
  Recorded recorded(1);
  const Eigen::Matrix3Xd positions = tetrahedron_at({0, 0, 0});
  const BodyId body = recorded.world.add_body(
      {.positions = positions, .facets = tetrahedron_facets(), .name = "body of mask 4294967295", .external_id = 77});
  recorded.world.detect();
  const std::string now = recorded.out.str();
  RecordingPlayer player(now, {.threads = 1, .outputs = {}});
  ASSERT_TRUE(player.next());
  EXPECT_EQ(player.world().external_id(player.world().bodies().at(body.index)), 77u);
  const std::string old = with(std::string(now).erase(kExternalIdAt, 8), kVersionAt, bytes_of(3u));
  EXPECT_TRUE(all_same(play(old)));
}

// What was not asked for when it was recorded can be asked for when it is played.
TEST(Recording, PlaysWithMoreOutputs) {
  const std::string bytes = recording();
  RecordingPlayer player(bytes, {.threads = 1, .outputs = {.patches = true}});
  std::size_t patches = 0;
  while (const auto step = player.next()) {
    EXPECT_TRUE(step->same());
    for (const Contact& contact : player.report().contacts()) patches += contact.patches().size();
  }
  EXPECT_GT(patches, 0u);
}

TEST(Recording, HoldsKeysAndRestoredStates) {
  Recorded recorded(1);
  const Eigen::Matrix3Xd here = tetrahedron_at({0, 0, 0}), there = tetrahedron_at({0.3, 0.1, 0.1});
  const Eigen::Matrix3Xi facets = tetrahedron_facets();
  const BodyId a = recorded.world.add_body({.positions = here, .facets = facets, .key = 9});
  const BodyId b = recorded.world.add_body({.positions = there, .facets = facets, .key = 2});
  recorded.world.detect();
  World other({.threads = 1});
  other.add_body({.positions = here, .facets = facets, .name = "another"});
  const std::vector<std::byte> saved = recorded.world.save(), of_other = other.save();
  recorded.world.remove_body(a);
  recorded.world.detect();
  recorded.world.restore(of_other);
  const BodyId foreign = recorded.world.bodies().at(0);
  EXPECT_FALSE(recorded.world.contains(a));
  recorded.world.set_positions(foreign, there);
  recorded.world.detect();
  recorded.world.restore(saved);
  recorded.world.set_positions(b, here);  // ids of before, and of the body that was gone
  recorded.world.set_positions(a, there);
  recorded.world.detect();
  const std::string bytes = recorded.out.str();
  EXPECT_EQ(play(bytes).size(), 4u);
  EXPECT_TRUE(all_same(play(bytes)));
  RecordingPlayer with_points(bytes, {.threads = 1, .outputs = {.points = true}});
  while (with_points.next()) EXPECT_TRUE(with_points.world().settings().outputs.points);
}

TEST(Recorder, AnObserverSeesAWorldWhole) {
  World world;
  std::ostringstream out;
  Recorder recorder(out);
  const Eigen::Matrix3Xd positions = tetrahedron_at({0, 0, 0});
  world.remove_body(world.add_body({.positions = positions, .facets = tetrahedron_facets()}));
  try {
    world.set_observer(&recorder);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::wrong_order);
  }
  world.set_observer(nullptr);
}

// A disk that is full: the world goes on.
TEST(Recorder, StreamThatFailsStopsNobody) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);
  Recorder recorder(out);
  World world;
  world.set_observer(&recorder);
  out.exceptions(std::ios::goodbit);
  out.setstate(std::ios::badbit);
  const std::vector<std::uint64_t> hashes = make_calls(world);
  World silent;
  EXPECT_EQ(hashes, make_calls(silent));
  EXPECT_FALSE(out.good());
}

TEST(Recorder, GoesWithAWorldThatIsMoved) {
  Recorded recorded(1);
  World moved = std::move(recorded.world);
  make_calls(moved);
  EXPECT_EQ(play(recorded.out.str()).size(), 6u);
}

}  // namespace
}  // namespace tact::tests
