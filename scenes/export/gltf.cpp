#include "scenes/export/gltf.h"

#include <fmt/format.h>
#include <tact/version.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include "scenes/commands/json_text.h"
#include "scenes/pictures/drawn_scene.h"

namespace tact::scenes {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

namespace {

// The numbers by which glTF names types.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

// The three kinds of data, each a view of the file's one buffer. All items are made of four bytes, so all is aligned.
enum class Section : std::size_t { indices, positions, animation };

void append_word(std::string& bytes, std::uint32_t word) {
  bytes.append(reinterpret_cast<const char*>(&word), sizeof(word));
}

void check_frame(std::span<const PictureBody> bodies, std::size_t expected, double time,
                 const std::vector<float>& times) {
  if (!std::isfinite(time) || (!times.empty() && !(static_cast<float>(time) > times.back()))) {
    throw std::runtime_error(
        fmt::format("glTF: a frame at {} s after one at {} s", time, times.empty() ? 0.0f : times.back()));
  }
  if (!times.empty() && bodies.size() != expected) {
    throw std::runtime_error(fmt::format("glTF: a frame of {} bodies after one of {}", bodies.size(), expected));
  }
}

}  // namespace

void GltfAnimation::add_frame(std::span<const PictureBody> bodies, double time) {
  check_frame(bodies, bodies_.size(), time, times_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies[i].positions.cols() != bodies_[i].positions[0].cols()) {
      throw std::runtime_error(fmt::format("glTF: body {} changed its number of vertices from {} to {}", bodies[i].name,
                                           bodies_[i].positions[0].cols(), bodies[i].positions.cols()));
    }
  }
  if (times_.empty()) {
    for (const PictureBody& body : bodies) {
      bodies_.push_back({body.name, body.color, body.opacity, body.facets, {body.positions.cast<float>()}});
    }
  } else {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      std::vector<Eigen::Matrix3Xf>& positions = bodies_[i].positions;
      Eigen::Matrix3Xf moved = bodies[i].positions.cast<float>();
      if (positions.size() == 1 && moved == positions[0]) continue;
      positions.resize(times_.size(), Eigen::Matrix3Xf(positions[0]));
      positions.push_back(std::move(moved));
    }
  }
  times_.push_back(static_cast<float>(time));
}

// Builds the JSON part and the buffer side by side.
class GltfAnimation::Writer {
 public:
  explicit Writer(const GltfAnimation& animation) : animation_(animation) {
    root_["asset"] = {{"version", "2.0"}, {"generator", "tact " TACT_VERSION}};
    root_["scene"] = 0;
    root_["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
    root_["nodes"] = Json::array({{{"name", "scene"}}});
    const float half = std::sqrt(0.5f);
    if (animation.up_ == UpAxis::z) root_["nodes"][0]["rotation"] = Json::array({-half, 0.0, 0.0, half});
    for (const Body& body : animation.bodies_) add_body(body);
    if (!channels_.empty()) add_animation();
    add_buffer();
  }

  // The whole file.
  std::string bytes() const {
    std::string json = json_text(root_);
    json.append((4 - json.size() % 4) % 4, ' ');
    std::size_t data = 0;
    for (const std::string& view : views_) data += view.size();
    const std::size_t total = 12 + 8 + json.size() + (data > 0 ? 8 + data : 0);
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      throw std::runtime_error(fmt::format("glTF: {} bytes are more than a file can hold; export fewer frames", total));
    }
    std::string result;
    result.reserve(total);
    append_word(result, 0x46546C67);  // "glTF"
    append_word(result, 2);
    append_word(result, static_cast<std::uint32_t>(total));
    append_word(result, static_cast<std::uint32_t>(json.size()));
    append_word(result, 0x4E4F534A);  // "JSON"
    result += json;
    if (data == 0) return result;
    append_word(result, static_cast<std::uint32_t>(data));
    append_word(result, 0x004E4942);  // "BIN"
    for (const std::string& view : views_) result += view;
    return result;
  }

 private:
  // Appends `count` items to a view and returns the number of their accessor. The view's own number is filled in when
  // it is known which views have any bytes.
  int add_accessor(Section section, const void* data, std::size_t bytes, Json accessor) {
    std::string& target = views_[static_cast<std::size_t>(section)];
    accessor["bufferView"] = static_cast<std::size_t>(section);
    accessor["byteOffset"] = target.size();
    target.append(static_cast<const char*>(data), bytes);
    root_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(root_["accessors"].size()) - 1;
  }

  int add_positions(const Eigen::Matrix3Xf& positions) {
    const Eigen::Vector3f lower = positions.rowwise().minCoeff();
    const Eigen::Vector3f upper = positions.rowwise().maxCoeff();
    return add_accessor(Section::positions, positions.data(),
                        sizeof(float) * static_cast<std::size_t>(positions.size()),
                        {{"componentType", kFloat},
                         {"count", positions.cols()},
                         {"type", "VEC3"},
                         {"min", Json::array({lower.x(), lower.y(), lower.z()})},
                         {"max", Json::array({upper.x(), upper.y(), upper.z()})}});
  }

  int add_scalars(const std::vector<float>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return add_accessor(Section::animation, values.data(), sizeof(float) * values.size(),
                        {{"componentType", kFloat},
                         {"count", values.size()},
                         {"type", "SCALAR"},
                         {"min", Json::array({*least})},
                         {"max", Json::array({*most})}});
  }

  void add_body(const Body& body) {
    const std::size_t node = root_["nodes"].size();
    root_["nodes"][0]["children"].push_back(node);
    root_["nodes"].push_back({{"name", body.name}});
    if (body.facets.cols() == 0) return;  // a mesh without facets is not allowed
    const Eigen::Matrix<std::uint32_t, 3, Eigen::Dynamic> facets = body.facets.cast<std::uint32_t>();
    const int indices =
        add_accessor(Section::indices, facets.data(), sizeof(std::uint32_t) * static_cast<std::size_t>(facets.size()),
                     {{"componentType", kUnsignedInt}, {"count", facets.size()}, {"type", "SCALAR"}});
    Json primitive = {{"attributes", {{"POSITION", add_positions(body.positions[0])}}},
                      {"indices", indices},
                      {"material", add_material(body)},
                      {"mode", 4}};
    for (std::size_t frame = 1; frame < body.positions.size(); ++frame) {
      primitive["targets"].push_back({{"POSITION", add_positions(body.positions[frame] - body.positions[0])}});
    }
    root_["nodes"][node]["mesh"] = root_["meshes"].size();
    root_["meshes"].push_back({{"name", body.name}, {"primitives", Json::array({std::move(primitive)})}});
    if (body.positions.size() > 1) {
      channels_.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    }
  }

  std::size_t add_material(const Body& body) {
    const Light light = linear(body.color);
    Json material = {{"name", body.name},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", Json::array({light.x(), light.y(), light.z(), body.opacity})},
                       {"metallicFactor", 0.0},
                       {"roughnessFactor", 0.7}}},
                     {"doubleSided", true}};
    if (body.opacity < 1.0) material["alphaMode"] = "BLEND";
    root_["materials"].push_back(std::move(material));
    return root_["materials"].size() - 1;
  }

  // One sampler serves all bodies: at frame k target k - 1 has the weight 1.
  void add_animation() {
    const std::size_t frames = animation_.times_.size();
    std::vector<float> weights(frames * (frames - 1), 0.0f);
    for (std::size_t frame = 1; frame < frames; ++frame) weights[frame * (frames - 1) + frame - 1] = 1.0f;
    const int input = add_scalars(animation_.times_);
    const int output = add_scalars(weights);
    root_["animations"] =
        Json::array({{{"name", "run"},
                      {"samplers", Json::array({{{"input", input}, {"interpolation", "LINEAR"}, {"output", output}}})},
                      {"channels", channels_}}});
  }

  void add_buffer() {
    std::array<int, 3> numbers{};
    std::size_t offset = 0;
    for (std::size_t view = 0; view < views_.size(); ++view) {
      if (views_[view].empty()) continue;
      numbers[view] = static_cast<int>(root_["bufferViews"].size());
      Json json = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", views_[view].size()}};
      if (view == static_cast<std::size_t>(Section::indices)) json["target"] = kElementArrayBuffer;
      if (view == static_cast<std::size_t>(Section::positions)) json["byteStride"] = 3 * sizeof(float);
      if (view == static_cast<std::size_t>(Section::positions)) json["target"] = kArrayBuffer;
      root_["bufferViews"].push_back(std::move(json));
      offset += views_[view].size();
    }
    if (offset == 0) return;
    for (Json& accessor : root_["accessors"]) {
      accessor["bufferView"] = numbers[accessor["bufferView"].get<std::size_t>()];
    }
    root_["buffers"] = Json::array({{{"byteLength", offset}}});
  }

  const GltfAnimation& animation_;
  Json root_;
  Json channels_ = Json::array();
  std::array<std::string, 3> views_;
};

void GltfAnimation::write(std::ostream& out) const {
  if (times_.empty()) throw std::runtime_error("glTF: no frame to write");
  const std::string bytes = Writer(*this).bytes();
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace tact::scenes
