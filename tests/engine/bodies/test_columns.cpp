// Positions and facets as engines hold them: floats with strides, indices of 16 and 32 bits.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"

namespace tact::tests {
namespace {

constexpr std::size_t kVertexBytes = 32;

// The vertices of a mesh as an engine has them: three floats at the begin of every 32 bytes, the rest something else.
std::vector<std::byte> vertex_buffer(const Eigen::Matrix3Xd& positions) {
  std::vector<std::byte> buffer(kVertexBytes * static_cast<std::size_t>(positions.cols()), std::byte{0xff});
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Eigen::Vector3f position = positions.col(i).cast<float>();
    std::memcpy(buffer.data() + kVertexBytes * static_cast<std::size_t>(i), position.data(), 3 * sizeof(float));
  }
  return buffer;
}

Positions view(const std::vector<std::byte>& buffer) {
  return Positions::strided(reinterpret_cast<const float*>(buffer.data()), buffer.size() / kVertexBytes, kVertexBytes);
}

Eigen::Matrix3Xd widened(const Eigen::Matrix3Xd& positions) { return positions.cast<float>().cast<double>(); }

// 10,000 bodies in one call, none copied by the program; the answer is that of the same values as doubles.
TEST(StridedFloats, OfTenThousandBodiesAnswerAsTheSameDoubles) {
  const std::vector<Mesh> bodies = crowd_of_blobs(20, 3);
  constexpr std::size_t kCopies = 500;
  World floats({.threads = 2}), doubles({.threads = 2});
  std::vector<BodyId> float_ids, double_ids;
  std::vector<std::vector<std::byte>> buffers;
  std::vector<Eigen::Matrix3Xd> wide;
  for (std::size_t copy = 0; copy < kCopies; ++copy) {
    for (const Mesh& body : bodies) {
      const Mesh moved = translated(body, {40.0 * static_cast<double>(copy), 0.0, 0.0});
      wide.push_back(widened(moved.positions));
      buffers.push_back(vertex_buffer(moved.positions));
      double_ids.push_back(doubles.add_body({.positions = wide.back(), .facets = body.facets}));
      float_ids.push_back(floats.add_body({.positions = view(buffers.back()), .facets = body.facets}));
    }
  }
  ASSERT_EQ(floats.detect().hash(), doubles.detect().hash());
  std::vector<PositionsUpdate> float_updates, double_updates;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    wide[i] = widened(wide[i].array() + 0.01 * static_cast<double>(i % 7));
    buffers[i] = vertex_buffer(wide[i]);
    float_updates.push_back({float_ids[i], view(buffers[i])});
    double_updates.push_back({double_ids[i], wide[i]});
  }
  floats.set_positions(float_updates);
  doubles.set_positions(double_updates);
  const Report& report = floats.detect();
  EXPECT_EQ(report.stats().moved_bodies, 8571);  // of each seven the first is where it was
  EXPECT_EQ(report.contacts().size(), 7000u);
  EXPECT_EQ(report.hash(), doubles.detect().hash());
}

TEST(StridedFloats, OfOneBodyAreSetFromMemoryWithoutAlignment) {
  const Mesh mesh = icosphere(2);
  const Eigen::Matrix3Xd moved = widened(mesh.positions.array() * 1.5);
  World world, expected;
  for (World* each : {&world, &expected}) each->add_body({.positions = mesh.positions, .facets = mesh.facets});
  for (World* each : {&world, &expected}) {
    each->add_body({.positions = translated(mesh, {1.9, 0.1, 0.2}).positions, .facets = mesh.facets});
  }
  std::vector<std::byte> buffer = vertex_buffer(moved);
  buffer.insert(buffer.begin(), std::byte{0});
  world.set_positions(world.bodies()[0],
                      Positions::of_kind(NumberKind::float32, buffer.data() + 1, mesh.vertex_count(), kVertexBytes));
  expected.set_positions(expected.bodies()[0], moved);
  EXPECT_EQ(world.detect().hash(), expected.detect().hash());
}

TEST(StridedFacets, OfEveryKindAreTheSameFacets) {
  const Mesh mesh = icosphere(2), other = translated(mesh, {1.9, 0.1, 0.2});
  const auto count = static_cast<std::size_t>(mesh.facet_count());
  std::vector<std::uint16_t> shorts;
  std::vector<std::uint32_t> unsigneds;
  std::vector<int> wide;  // four to a facet
  for (Eigen::Index f = 0; f < mesh.facets.cols(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      shorts.push_back(static_cast<std::uint16_t>(mesh.facets(corner, f)));
      unsigneds.push_back(static_cast<std::uint32_t>(mesh.facets(corner, f)));
      wide.push_back(mesh.facets(corner, f));
    }
    wide.push_back(-1);
  }
  const auto hash_of = [&](const Facets& facets) {
    World world;
    world.add_body({.positions = mesh.positions, .facets = facets});
    world.add_body({.positions = other.positions, .facets = facets});
    return world.detect().hash();
  };
  const std::uint64_t expected = hash_of(mesh.facets);
  EXPECT_EQ(hash_of(Facets::strided(shorts.data(), count)), expected);
  EXPECT_EQ(hash_of(Facets::strided(unsigneds.data(), count)), expected);
  EXPECT_EQ(hash_of(Facets::strided(wide.data(), count, 4 * sizeof(int))), expected);
}

ErrorCode code_of(const auto& call, const std::string& text) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    return error.code();
  }
  ADD_FAILURE() << "no error";
  return ErrorCode::backend_failure;
}

TEST(StridedArrays, ThatCannotBeTakenAreRefusedByName) {
  const Mesh mesh = icosphere(1);
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  World world;
  const BodyId body = world.add_body({.positions = mesh.positions, .facets = mesh.facets});
  const float* const nothing = nullptr;
  EXPECT_EQ(code_of([&] { world.set_positions(body, Positions::strided(nothing, count)); }, "is null"),
            ErrorCode::wrong_size);
  EXPECT_EQ(code_of([&] { world.set_positions(body, Positions::of_kind(NumberKind::int32, &count, count, 12)); },
                    "holds no float32 or float64"),
            ErrorCode::wrong_size);
  EXPECT_EQ(code_of([&] { world.set_positions(body, Positions::of_kind(NumberKind{77}, &count, count, 12)); },
                    "holds no float32"),
            ErrorCode::wrong_size);
  std::vector<float> floats(3 * count, 1.0f);
  floats[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(code_of([&] { world.set_positions(body, Positions::strided(floats.data(), count)); }, "vertex 1 has y"),
            ErrorCode::non_finite_position);
  EXPECT_EQ(code_of([&] { world.set_positions(body, Positions::strided(floats.data(), count - 1)); }, "positions were"),
            ErrorCode::wrong_size);
  const std::vector<std::uint32_t> facets = {0, 1, 2, 2, 1, 4000000000u};
  EXPECT_EQ(code_of([&] { world.add_body({.positions = mesh.positions, .facets = Facets::strided(facets.data(), 2)}); },
                    "facet 1 names vertex 4000000000"),
            ErrorCode::facet_out_of_range);
  EXPECT_EQ(world.body_count(), 1u);
}

TEST(ExternalId, IsKept) {
  tact::World world;
  const Mesh mesh = icosphere(0);
  const BodyId body = world.add_body({.positions = mesh.positions, .facets = mesh.facets, .external_id = ~0ull});
  const BodyId other = world.add_body({.positions = mesh.positions, .facets = mesh.facets});
  EXPECT_EQ(world.external_id(body), ~0ull);
  EXPECT_EQ(world.external_id(other), 0u);
}

}  // namespace
}  // namespace tact::tests
