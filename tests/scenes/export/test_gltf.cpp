#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/export/gltf.h"
#include "tests/scenes/picture_bodies.h"

using namespace tact::scenes;
using nlohmann::json;
using tact::tests::cube;

namespace {

struct Glb {
  json root;
  std::string data;

  // The values of an accessor, `components` an item.
  template <class T>
  std::vector<T> values(int accessor, std::size_t components) const {
    const json& a = root["accessors"][accessor];
    const json& view = root["bufferViews"][a["bufferView"].get<std::size_t>()];
    std::vector<T> result(components * a["count"].get<std::size_t>());
    const std::size_t from = view["byteOffset"].get<std::size_t>() + a["byteOffset"].get<std::size_t>();
    const std::size_t end = a["byteOffset"].get<std::size_t>() + result.size() * sizeof(T);
    EXPECT_LE(end, view["byteLength"].get<std::size_t>()) << "accessor " << accessor;
    EXPECT_EQ(from % 4, 0u);
    std::memcpy(result.data(), data.data() + from, result.size() * sizeof(T));
    return result;
  }
};

Glb written(const GltfAnimation& animation) {
  std::ostringstream out;
  animation.write(out);
  const std::string bytes = out.str();
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), bytes.size());
  const std::size_t json_size = word(12);
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  Glb glb{json::parse(bytes.substr(20, json_size)), {}};
  if (bytes.size() == 20 + json_size) return glb;
  EXPECT_EQ(bytes.substr(24 + json_size, 4), std::string("BIN\0", 4));
  EXPECT_EQ(word(20 + json_size), bytes.size() - 28 - json_size);
  glb.data = bytes.substr(28 + json_size);
  EXPECT_EQ(glb.data.size() % 4, 0u);
  return glb;
}

// Three frames: the first cube moves in the last alone, the second never.
Glb three_frames(UpAxis up) {
  GltfAnimation animation(up);
  std::vector<PictureBody> bodies{cube({0, 0, 0}, 1.0, body_color(0), "moves"),
                                  cube({5, 0, 0}, 2.0, body_color(1), "rests")};
  animation.add_frame(bodies, 0.0);
  animation.add_frame(bodies, 0.5);
  bodies[0].positions.array() += 0.25;
  animation.add_frame(bodies, 1.5);
  return written(animation);
}

}  // namespace

TEST(Gltf, BufferViewsCoverTheBufferInOrder) {
  const Glb glb = three_frames(UpAxis::y);
  std::size_t offset = 0;
  for (const json& view : glb.root["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"], offset);
    EXPECT_EQ(offset % 4, 0u);
    // Several accessors share the view of the positions: it must name its stride.
    EXPECT_EQ(view.value("byteStride", 0), view.value("target", 0) == 34962 ? 12 : 0);
    offset += view["byteLength"].get<std::size_t>();
  }
  EXPECT_EQ(glb.root["buffers"][0]["byteLength"], offset);
  EXPECT_EQ(glb.data.size(), offset);
}

TEST(Gltf, MeshesReadBackWithTheirBounds) {
  const Glb glb = three_frames(UpAxis::y);
  const PictureBody expected = cube({5, 0, 0}, 2.0, {});
  const json& primitive = glb.root["meshes"][1]["primitives"][0];
  const int accessor = primitive["attributes"]["POSITION"];
  const auto positions = glb.values<float>(accessor, 3);
  for (Eigen::Index i = 0; i < expected.positions.size(); ++i) {
    EXPECT_EQ(positions[i], static_cast<float>(expected.positions.reshaped()[i])) << i;
  }
  const json& a = glb.root["accessors"][accessor];
  EXPECT_EQ(a["min"], (json{5.0, 0.0, 0.0}));
  EXPECT_EQ(a["max"], (json{7.0, 2.0, 2.0}));
  const auto indices = glb.values<std::uint32_t>(primitive["indices"], 1);
  ASSERT_EQ(indices.size(), 36u);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    EXPECT_EQ(static_cast<int>(indices[i]), expected.facets.reshaped()[i]) << i;
  }
  EXPECT_FALSE(primitive.contains("targets")) << "a body at rest needs no morph targets";
}

TEST(Gltf, MorphTargetsAndWeightsGiveEachFrame) {
  const Glb glb = three_frames(UpAxis::y);
  const json& targets = glb.root["meshes"][0]["primitives"][0]["targets"];
  ASSERT_EQ(targets.size(), 2u);
  for (const float delta : glb.values<float>(targets[0]["POSITION"], 3)) EXPECT_EQ(delta, 0.0f);
  for (const float delta : glb.values<float>(targets[1]["POSITION"], 3)) EXPECT_EQ(delta, 0.25f);
  for (const json& target : targets) {
    const json& a = glb.root["accessors"][target["POSITION"].get<std::size_t>()];
    EXPECT_TRUE(a.contains("min") && a.contains("max"));
  }
  const json& animation = glb.root["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 1u);
  EXPECT_EQ(glb.root["nodes"][animation["channels"][0]["target"]["node"].get<std::size_t>()]["name"], "moves");
  const json& sampler = animation["samplers"][0];
  EXPECT_EQ(glb.values<float>(sampler["input"], 1), (std::vector<float>{0.0f, 0.5f, 1.5f}));
  const json& times = glb.root["accessors"][sampler["input"].get<std::size_t>()];
  EXPECT_EQ(times["min"], json{0.0});
  EXPECT_EQ(times["max"], json{1.5});
  EXPECT_EQ(glb.values<float>(sampler["output"], 1), (std::vector<float>{0, 0, 1, 0, 0, 1}));
}

TEST(Gltf, ZUpScenesAreTurned) {
  EXPECT_FALSE(three_frames(UpAxis::y).root["nodes"][0].contains("rotation"));
  const Glb turned = three_frames(UpAxis::z);
  const json& q = turned.root["nodes"][0]["rotation"];
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  EXPECT_TRUE((rotation * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-6));
}

TEST(Gltf, BodiesWithoutFacetsAndSingleFrames) {
  GltfAnimation animation(UpAxis::y);
  std::vector<PictureBody> bodies(1);
  bodies[0].name = "nothing";
  animation.add_frame(bodies, 0.0);
  const Glb glb = written(animation);
  EXPECT_EQ(glb.root["nodes"].size(), 2u);
  for (const char* absent : {"meshes", "accessors", "bufferViews", "buffers", "animations"}) {
    EXPECT_FALSE(glb.root.contains(absent)) << absent << ": empty arrays are not allowed";
  }
}

TEST(Gltf, FramesThatDoNotFitAreRefused) {
  GltfAnimation animation(UpAxis::y);
  EXPECT_THROW(written(animation), std::runtime_error);
  std::vector<PictureBody> bodies{cube({0, 0, 0}, 1.0, {})};
  animation.add_frame(bodies, 1.0);
  EXPECT_THROW(animation.add_frame(bodies, 1.0), std::runtime_error);
  EXPECT_THROW(animation.add_frame({}, 2.0), std::runtime_error);
  bodies[0].positions.conservativeResize(3, 7);
  EXPECT_THROW(animation.add_frame(bodies, 2.0), std::runtime_error);
  EXPECT_EQ(animation.frames(), 1);
}
