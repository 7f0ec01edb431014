#include "scenes/pictures/painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace tact::scenes {
namespace {

constexpr float kAbove = 2e-4f;          // how far above a surface its rays start, in units of the drawn scene
constexpr int kSeeThrough = 8;           // see-through surfaces one behind the other; the next counts as opaque
constexpr int kSmoothReach = kTile / 2;  // pixels
constexpr float kInfinity = std::numeric_limits<float>::infinity();

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

}  // namespace

const Painter::Place Painter::kFourSamples[4] = {
    {0.375f, 0.125f}, {0.875f, 0.375f}, {0.625f, 0.875f}, {0.125f, 0.625f}};

Painter::Painter(const DrawnScene& scene, int width, int height, int samples_per_pixel)
    : scene_(scene),
      lights_(scene),
      width_(width),
      height_(height),
      fine_(samples_per_pixel > 1),
      buffer_(width, height),
      sketch_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      backdrop_top_(linear({176, 200, 224})),
      backdrop_bottom_(linear({240, 241, 240})) {}

void Painter::light(int x, int y) {
  const std::optional<Met> met = meet(ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}));
  if (!met) return;
  const bool open_floor =
      met->point.mesh == nullptr && !lights_.near_sky(met->point.place) && !lights_.near_sun(met->point.place);
  if (!open_floor) buffer_.set(x, y, met->point, lighting(met->point, pattern_.of_pixel(x, y)));
}

void Painter::smooth_light(int threads) { buffer_.smooth(kSmoothReach, threads); }

void Painter::sketch(int x, int y) {
  sketch_[index(x, y)] = shoulder(trace({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}));
}

Color Painter::color(int x, int y) const {
  if (!fine_ || calm(x, y)) return displayed(sketch_[index(x, y)]);
  Light sum = Light::Zero();
  for (const Place& sample : kFourSamples) {
    sum += shoulder(trace({static_cast<float>(x) + sample.x, static_cast<float>(y) + sample.y}));
  }
  return displayed(sum / static_cast<float>(std::size(kFourSamples)));
}

std::size_t Painter::index(int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
}

bool Painter::calm(int x, int y) const {
  constexpr float kSame = 0.06f;  // greatest difference of a channel, as a share of the brighter one
  constexpr float kDark = 0.02f;  // differences below this share of white are seen by nobody
  const Light& here = sketch_[index(x, y)];
  for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
      const Light& there = sketch_[index(u, v)];
      const Light greatest = kSame * here.cwiseMax(there).cwiseMax(kDark);
      if (((here - there).cwiseAbs().array() > greatest.array()).any()) return false;
    }
  }
  return true;
}

Ray Painter::ray(const Place& place) const {
  const float across = 2.0f * place.x / static_cast<float>(width_) - 1.0f;
  const float down = 2.0f * place.y / static_cast<float>(height_) - 1.0f;
  return {.origin = scene_.eye,
          .direction = (scene_.forward + across * scene_.right + down * scene_.down).normalized()};
}

Light Painter::backdrop(const Place& place) const {
  const float share = smoothstep(-0.05f, 0.85f, place.y / static_cast<float>(height_));
  return backdrop_top_ + share * (backdrop_bottom_ - backdrop_top_);
}

std::optional<Painter::Met> Painter::meet(const Ray& ray) const {
  const float fall = ray.direction.dot(scene_.up);
  const float floor_distance =
      scene_.ground && fall < 0.0f ? (*scene_.ground - ray.origin.dot(scene_.up)) / fall : kInfinity;
  const std::optional<RayHit> hit = scene_.bodies.rays.closest(ray);
  const bool floor_seen = floor_distance > ray.nearest && floor_distance < kInfinity;
  if (floor_seen && (!hit || hit->distance > floor_distance)) {
    const Eigen::Vector3f place = ray.origin + floor_distance * ray.direction + kAbove * scene_.up;
    return Met{.distance = floor_distance, .point = {.place = place, .normal = scene_.up, .mesh = nullptr}};
  }
  if (!hit) return std::nullopt;
  return met(scene_.bodies.meshes[hit->mesh], *hit, ray);
}

Painter::Met Painter::met(const DrawnMesh& mesh, const RayHit& hit, const Ray& ray) const {
  const bool inner = hit.normal.dot(ray.direction) > 0.0f;
  const float side = inner ? -1.0f : 1.0f;
  const Eigen::Vector3f facet_normal = side * hit.normal;
  LitPoint point{.place = ray.origin + hit.distance * ray.direction, .normal = facet_normal, .mesh = &mesh};
  const auto facet = static_cast<Eigen::Index>(hit.facet);
  if (mesh.corner_normals.cols() > 0) {
    // A coarse mesh would show its facets in its own shadow: the lit point moves out onto the curved surface that the
    // normals promise. Source: J. Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021.
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f lift = Eigen::Vector3f::Zero();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f corner_normal = side * mesh.corner_normals.col(3 * facet + k);
      const Eigen::Vector3f corner = mesh.positions.col(mesh.facets(k, facet));
      const float weight = hit.weights[k];
      normal += weight * corner_normal;
      lift -= weight * std::min(0.0f, (point.place - corner).dot(corner_normal)) * corner_normal;
    }
    if (normal.squaredNorm() > 0.0f) point.normal = normal.normalized();
    point.place += lift;
  }
  point.place += kAbove * facet_normal;
  return {.distance = hit.distance, .point = point, .inner = inner, .edge = mesh.edges ? edge_seen(mesh, hit) : 0.0f};
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
    to_edge = std::min(to_edge, hit.weights[k] * height);
    smallest_height = std::min(smallest_height, height);
  }
  return (1.0f - smoothstep(0.3f, 1.0f, to_edge)) * smoothstep(7.0f, 22.0f, smallest_height);
}

Lighting Painter::lighting(const LitPoint& point, const DiskPoints& points) const {
  const Light bounce = 0.12f * (point.mesh != nullptr ? point.mesh->reflectance : lights_.open_sky());
  const bool turned_to_sun = point.normal.dot(lights_.sun()) > 0.0f;
  return {.sky = lights_.sky(point, points, bounce),
          .sun_seen = turned_to_sun ? lights_.sun_seen(point, points) : 0.0f};
}

Lighting Painter::stored_lighting(const LitPoint& point, const Place& place) const {
  const int x = static_cast<int>(place.x);
  const int y = static_cast<int>(place.y);
  const Lighting* stored = buffer_.find(x, y, point);
  return stored != nullptr ? *stored : lighting(point, pattern_.of_pixel(x, y));
}

// Front to back through what is see-through, then the marks over it.
Light Painter::trace(const Place& place) const {
  Ray ray = this->ray(place);
  Light seen = Light::Zero();
  float left = 1.0f;
  float distance = kInfinity;
  for (int depth = 0; left > 0.0f; ++depth) {
    const std::optional<Met> met = meet(ray);
    if (!met || met->point.mesh == nullptr) {
      seen += left * (met ? floor(*met, place) : backdrop(place));
      break;
    }
    const DrawnMesh& mesh = *met->point.mesh;
    const bool opaque = mesh.opacity >= 1.0f || depth == kSeeThrough;
    // A thin shell is seen through less where the view grazes it.
    const float grazing = 1.0f - std::abs(met->point.normal.dot(ray.direction));
    const float share = opaque ? 1.0f : std::min(1.0f, mesh.opacity * (0.7f + 1.3f * grazing * grazing));
    seen += left * share * shaded(*met, ray, place);
    left = opaque ? 0.0f : left * (1.0f - share);
    if (opaque) distance = met->distance;
    ray.nearest = met->distance * (1.0f + 1e-5f) + kAbove;
  }
  ray.nearest = 0.0f;
  for (const DrawnLayer& layer : scene_.marks) seen = marked(seen, layer, ray, distance);
  return seen;
}

Light Painter::shaded(const Met& met, const Ray& ray, const Place& place) const {
  const Light reflectance = (met.inner ? 0.72f : 1.0f) * (1.0f - 0.3f * met.edge) * met.point.mesh->reflectance;
  const Lighting lit = stored_lighting(met.point, place);
  const Light sun = lit.sun_seen * lights_.sun_light();
  const float towards_sun = std::max(0.0f, met.point.normal.dot(lights_.sun()));
  const Eigen::Vector3f half = (lights_.sun() - ray.direction).normalized();
  const float shine = 0.05f * std::pow(std::max(0.0f, half.dot(met.point.normal)), 28.0f);
  return reflectance.cwiseProduct(lit.sky + towards_sun * sun) + shine * sun;
}

// The floor is the backdrop itself, darkened where bodies keep light away: it has no end and no horizon.
Light Painter::floor(const Met& met, const Place& place) const {
  if (!lights_.near_sky(met.point.place) && !lights_.near_sun(met.point.place)) return backdrop(place);
  const Light open = lights_.open_sky();
  const Light sun = scene_.up.dot(lights_.sun()) * lights_.sun_light();
  const Lighting lit = stored_lighting(met.point, place);
  return backdrop(place).cwiseProduct((lit.sky + lit.sun_seen * sun).cwiseQuotient(open + sun));
}

// Marks are lit from the viewer, so that they read the same everywhere.
Light Painter::marked(const Light& seen, const DrawnLayer& layer, const Ray& ray, float distance) const {
  const std::optional<RayHit> hit = layer.rays.closest(ray);
  if (!hit) return seen;
  const DrawnMesh& mesh = layer.meshes[hit->mesh];
  const Met mark = met(mesh, *hit, ray);
  const bool hidden = hit->distance > distance * (1.0f + 1e-5f) + 2.0f * kAbove;
  const float facing = std::abs(mark.point.normal.dot(ray.direction));
  const Light color = (0.55f + 0.45f * facing) * (1.0f - 0.55f * mark.edge) * mesh.reflectance;
  return seen + (hidden ? mesh.hidden_opacity : mesh.opacity) * (color - seen);
}

}  // namespace tact::scenes
