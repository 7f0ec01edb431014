#include "scenes/pictures/renderer.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "engine/base/parallel.h"
#include "scenes/pictures/drawn_scene.h"
#include "scenes/pictures/light.h"
#include "scenes/pictures/sampling.h"

namespace tact::scenes {
namespace {

constexpr float kAbove = 2e-4f;   // how far above a surface its rays start, in units of the drawn scene
constexpr int kSeeThrough = 8;    // see-through surfaces one behind the other; the next counts as opaque
constexpr std::size_t kRows = 4;  // rows of pixels that a thread takes at a time
const Color kInk{38, 44, 54};

// Places of the samples in a pixel.
struct PixelPoint {
  float x = 0.0f;
  float y = 0.0f;
};
constexpr PixelPoint kOneSample[] = {{0.5f, 0.5f}};
constexpr PixelPoint kFourSamples[] = {{0.375f, 0.125f}, {0.875f, 0.375f}, {0.625f, 0.875f}, {0.125f, 0.625f}};

float smoothstep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Bright light approaches white without reaching it, so that lit surfaces keep their form. It works on samples, not on
// pixels: a bright sample must not outshine the others at the rim of a body.
Light shoulder(const Light& light) {
  constexpr float kStart = 0.62f;
  constexpr float kRoom = 1.0f - kStart;
  return light.unaryExpr([](float v) { return v <= kStart ? v : 1.0f - kRoom * std::exp((kStart - v) / kRoom); });
}

// Where a ray meets a mesh, and how the surface is turned there.
struct Surface {
  Eigen::Vector3f place;
  Eigen::Vector3f facet_normal;  // towards the viewer
  Eigen::Vector3f normal;        // for shading, towards the viewer
  bool inner = false;            // the side from which the facet turns clockwise
  float edge = 0.0f;             // how much of an edge of the facet is seen, 0 to 1
};

struct Sample {
  std::uint32_t index = 0;  // in its pixel
  PixelTurn turn;
  Light backdrop;
};

class Painter {
 public:
  Painter(const DrawnScene& scene, const RenderSettings& settings)
      : scene_(scene),
        lights_(scene),
        width_(settings.width),
        height_(settings.height),
        samples_(settings.quality == Quality::draft ? std::span<const PixelPoint>(kOneSample) : kFourSamples),
        pattern_(static_cast<std::uint32_t>(samples_.size())) {}

  Color pixel(int x, int y) const;

 private:
  Light trace(Ray ray, const Sample& sample) const;
  Light shaded(const DrawnMesh& mesh, const Surface& surface, const Ray& ray, const Sample& sample) const;
  Light floor(const Eigen::Vector3f& place, const Sample& sample) const;
  Light marked(Light seen, const DrawnLayer& layer, const Ray& ray, float distance) const;
  Surface surface(const DrawnMesh& mesh, const RayHit& hit, const Ray& ray) const;
  float edge_seen(const DrawnMesh& mesh, const RayHit& hit) const;

  const DrawnScene& scene_;
  Lights lights_;
  Light backdrop_top_ = linear({176, 200, 224});
  Light backdrop_bottom_ = linear({240, 241, 240});
  int width_;
  int height_;
  std::span<const PixelPoint> samples_;
  DiskPattern pattern_;
};

Color Painter::pixel(int x, int y) const {
  const PixelTurn turn = pixel_turn(x, y);
  Light sum = Light::Zero();
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    const float across = 2.0f * (static_cast<float>(x) + samples_[i].x) / static_cast<float>(width_) - 1.0f;
    const float down = 2.0f * (static_cast<float>(y) + samples_[i].y) / static_cast<float>(height_) - 1.0f;
    Sample sample{.index = i, .turn = turn, .backdrop = {}};
    sample.backdrop = backdrop_top_ + smoothstep(-1.1f, 0.7f, down) * (backdrop_bottom_ - backdrop_top_);
    const Eigen::Vector3f direction = (scene_.forward + across * scene_.right + down * scene_.down).normalized();
    sum += shoulder(trace({.origin = scene_.eye, .direction = direction}, sample));
  }
  return displayed(sum / static_cast<float>(samples_.size()));
}

// Front to back through what is see-through, then the marks over it.
Light Painter::trace(Ray ray, const Sample& sample) const {
  const float fall = ray.direction.dot(scene_.up);
  const float floor_distance = scene_.ground && fall < 0.0f ? (*scene_.ground - ray.origin.dot(scene_.up)) / fall
                                                            : std::numeric_limits<float>::infinity();
  Light seen = Light::Zero();
  float left = 1.0f;
  float distance = std::numeric_limits<float>::infinity();
  for (int depth = 0; left > 0.0f; ++depth) {
    const std::optional<RayHit> hit = scene_.bodies.rays.closest(ray);
    if (!hit || hit->distance > floor_distance) {
      const bool on_floor = floor_distance > 0.0f && std::isfinite(floor_distance);
      seen += left * (on_floor ? floor(ray.origin + floor_distance * ray.direction, sample) : sample.backdrop);
      break;
    }
    const DrawnMesh& mesh = scene_.bodies.meshes[hit->mesh];
    const Surface met = surface(mesh, *hit, ray);
    // A thin shell is seen through less where the view grazes it.
    const float grazing = 1.0f - std::abs(met.normal.dot(ray.direction));
    const bool opaque = mesh.opacity >= 1.0f || depth == kSeeThrough;
    const float share = opaque ? 1.0f : std::min(1.0f, mesh.opacity * (0.7f + 1.3f * grazing * grazing));
    seen += left * share * shaded(mesh, met, ray, sample);
    left *= 1.0f - share;
    if (opaque) distance = hit->distance;
    if (opaque) break;
    ray.nearest = hit->distance * (1.0f + 1e-5f) + kAbove;
  }
  ray.nearest = 0.0f;
  for (const DrawnLayer& layer : scene_.marks) seen = marked(seen, layer, ray, distance);
  return seen;
}

Surface Painter::surface(const DrawnMesh& mesh, const RayHit& hit, const Ray& ray) const {
  Surface result;
  result.place = ray.origin + hit.distance * ray.direction;
  result.inner = hit.normal.dot(ray.direction) > 0.0f;
  const float side = result.inner ? -1.0f : 1.0f;
  result.facet_normal = side * hit.normal;
  result.normal = result.facet_normal;
  const auto facet = static_cast<Eigen::Index>(hit.facet);
  if (mesh.corner_normals.cols() > 0) {
    // A coarse mesh would show its facets in its own shadow: the lit point moves out onto the curved surface that the
    // normals promise. Source: J. Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021.
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f lift = Eigen::Vector3f::Zero();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f corner_normal = side * mesh.corner_normals.col(3 * facet + k);
      const Eigen::Vector3f corner = mesh.positions.col(mesh.facets(k, facet));
      const float weight = hit.weights[static_cast<std::size_t>(k)];
      normal += weight * corner_normal;
      lift -= weight * std::min(0.0f, (result.place - corner).dot(corner_normal)) * corner_normal;
    }
    if (normal.squaredNorm() > 0.0f) result.normal = normal.normalized();
    result.place += lift;
  }
  result.place += kAbove * result.facet_normal;
  result.edge = mesh.edges ? edge_seen(mesh, hit) : 0.0f;
  return result;
}

// Edges are a pixel wide and fade out where facets become small.
float Painter::edge_seen(const DrawnMesh& mesh, const RayHit& hit) const {
  const auto facet = static_cast<Eigen::Index>(hit.facet);
  const auto corner = [&](int k) -> Eigen::Vector3f { return mesh.positions.col(mesh.facets(k % 3, facet)); };
  const float twice_area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  const float pixel = 2.0f * hit.distance * scene_.down.norm() / static_cast<float>(height_);
  float to_edge = std::numeric_limits<float>::infinity();
  float smallest_height = to_edge;
  for (int k = 0; k < 3; ++k) {
    const float height = twice_area / (pixel * (corner(k + 2) - corner(k + 1)).norm());
    to_edge = std::min(to_edge, hit.weights[static_cast<std::size_t>(k)] * height);
    smallest_height = std::min(smallest_height, height);
  }
  return (1.0f - smoothstep(0.3f, 1.0f, to_edge)) * smoothstep(7.0f, 22.0f, smallest_height);
}

Light Painter::shaded(const DrawnMesh& mesh, const Surface& met, const Ray& ray, const Sample& sample) const {
  const Light reflectance = (met.inner ? 0.72f : 1.0f) * (1.0f - 0.3f * met.edge) * mesh.reflectance;
  const LitPoint point{met.place, met.normal};
  Light light = lights_.sky(point, pattern_.points(sample.index, sample.turn), 0.12f * mesh.reflectance);
  Light shine = Light::Zero();
  const float towards_sun = met.normal.dot(lights_.sun());
  if (towards_sun > 0.0f) {
    const float seen = lights_.sun_seen(point, pattern_.points(sample.index, sample.turn));
    light += towards_sun * seen * lights_.sun_light();
    const Eigen::Vector3f half = (lights_.sun() - ray.direction).normalized();
    shine = 0.05f * seen * std::pow(std::max(0.0f, half.dot(met.normal)), 28.0f) * lights_.sun_light();
  }
  return reflectance.cwiseProduct(light) + shine;
}

// The floor is the backdrop itself, darkened where bodies keep light away: it has no end and no horizon.
Light Painter::floor(const Eigen::Vector3f& place, const Sample& sample) const {
  const LitPoint point{place + kAbove * scene_.up, scene_.up};
  const bool near_sky = lights_.near_sky(place);
  const bool near_sun = lights_.near_sun(place);
  if (!near_sky && !near_sun) return sample.backdrop;
  const DiskPoints points = pattern_.points(sample.index, sample.turn);
  const Light open = lights_.open_sky();
  const Light sun = scene_.up.dot(lights_.sun()) * lights_.sun_light();
  const Light sky = near_sky ? lights_.sky(point, points, 0.1f * open) : open;
  const float seen = near_sun ? lights_.sun_seen(point, points) : 1.0f;
  return sample.backdrop.cwiseProduct((sky + seen * sun).cwiseQuotient(open + sun));
}

// Marks are lit from the viewer, so that they read the same everywhere.
Light Painter::marked(Light seen, const DrawnLayer& layer, const Ray& ray, float distance) const {
  const std::optional<RayHit> hit = layer.rays.closest(ray);
  if (!hit) return seen;
  const DrawnMesh& mesh = layer.meshes[hit->mesh];
  const Surface met = surface(mesh, *hit, ray);
  const bool hidden = hit->distance > distance * (1.0f + 1e-5f) + 2.0f * kAbove;
  const float facing = std::abs(met.normal.dot(ray.direction));
  const Light color = (0.55f + 0.45f * facing) * (1.0f - 0.55f * met.edge) * mesh.reflectance;
  return seen + (hidden ? mesh.hidden_opacity : mesh.opacity) * (color - seen);
}

}  // namespace

Renderer::Renderer(const RenderSettings& settings) : settings_(settings) {
  if (settings.width < 1 || settings.height < 1) {
    throw std::runtime_error(fmt::format("a picture of {} x {} pixels", settings.width, settings.height));
  }
  if (settings_.threads <= 0) settings_.threads = base::default_threads();
}

Picture Renderer::render(const PictureScene& scene, const Camera& camera) {
  const DrawnScene drawn = drawn_scene(scene, camera, settings_.threads);
  const Painter painter(drawn, settings_);
  Picture picture(settings_.width, settings_.height);
  base::parallel_for(static_cast<std::size_t>(picture.height), kRows, settings_.threads, [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < picture.width; ++x) picture.at(x, y) = painter.pixel(x, y);
  });
  const int size = std::max(9, picture.height / 30);
  font_.draw(picture, scene.title, size, 2 * size, size + size / 4, kInk);
  font_.draw(picture, scene.caption, size, picture.height - size, size - size / 6, kInk);
  return picture;
}

Picture Renderer::render(const PictureScene& scene) {
  return render(scene, framing(used_positions(scene), scene.up, settings_.width, settings_.height));
}

}  // namespace tact::scenes
