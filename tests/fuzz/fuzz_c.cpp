// Any bytes are calls of the interface for C that end with a documented error, and never with one of its own.
#include <tact/tact_c.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

namespace {

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s; the last error: %s\n", promise, tact_last_error_message());
  std::abort();
}

// Whether a call went well.
bool check(tact_error error) {
  require(error != TACT_ERROR_INTERNAL, "no error is internal");
  require(std::strcmp(tact_error_code_name(error), "unknown") != 0, "an error has a name");
  return error == TACT_OK;
}

// Numbers out of the bytes; zeros after their end.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return at_ >= size_; }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : data_[at_++]; }
  // Small numbers, most of them on a grid, and the hardest ones.
  double number() {
    constexpr std::array kHard = {0.0,
                                  -0.0,
                                  5e-324,
                                  1e-310,
                                  1e-160,
                                  0x1p-1022,
                                  0x1p300,
                                  -0x1p300,
                                  0x1p301,
                                  1e308,
                                  std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::quiet_NaN()};
    const std::uint8_t b = byte();
    if (b < kHard.size()) return kHard[b];
    return (b - 128) * 0.125;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

// A world, the bodies that were made in it, and the calls.
class Session {
 public:
  explicit Session(Input& input) : input_(input) {
    tact_settings settings = TACT_SETTINGS_INIT;
    settings.threads = 1;
    require(check(tact_world_create(&settings, &world_)), "a world is made");
  }
  ~Session() { check(tact_world_destroy(world_)); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void call() {
    switch (input_.byte() % 16) {
      case 0:
      case 1: return add_body();
      case 2: return set_positions();
      case 3:
      case 4: return detect();
      case 5: return motion();
      case 6: return queries();
      case 7: return settings();
      case 8: return set_pose();
      case 9: check(tact_world_remove_body(world_, body())); return;
      case 10: check(tact_world_set_margin(world_, body(), input_.number())); return;
      case 11: check(tact_world_set_self_contact(world_, body(), input_.byte() % 2 == 1)); return;
      case 12: check(tact_world_set_motion(world_, body(), input_.byte() % 5 - 1)); return;
      case 13: check(tact_world_set_excluded(world_, body(), body(), input_.byte() % 2 == 1)); return;
      case 14: check(tact_world_set_layers(world_, body(), input_.byte(), input_.byte())); return;
      case 15: return weld();
    }
  }

 private:
  // One that was added, be it removed since, or none.
  tact_body body() {
    const std::uint8_t b = input_.byte();
    return b < bodies_.size() ? bodies_[b] : tact_body{b, 1, 0};
  }

  // Most indices are those of vertices.
  void read_mesh() {
    positions_.resize(std::size_t{3} * (input_.byte() % 9));
    facets_.resize(std::size_t{3} * (input_.byte() % 9));
    for (double& x : positions_) x = input_.number();
    const auto vertices = static_cast<int>(positions_.size() / 3);
    for (int& corner : facets_) {
      const std::uint8_t b = input_.byte();
      corner = b == 255 || vertices == 0 ? b - 200 : b % vertices;
    }
  }
  tact_columns positions() const { return {positions_.data(), positions_.size() / 3, 24, TACT_FLOAT64}; }
  tact_columns facets() const { return {facets_.data(), facets_.size() / 3, 12, TACT_INT32}; }

  void add_body() {
    read_mesh();
    tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
    definition.positions = positions();
    definition.facets = facets();
    definition.surface = input_.byte() % 3;
    definition.motion = input_.byte() % 4;
    definition.margin = input_.number();
    definition.self_contact = input_.byte() % 2 == 1;
    tact_body added;
    if (check(tact_world_add_body(world_, &definition, &added))) bodies_.push_back(added);
  }

  void set_positions() {
    const tact_body moved = body();
    std::size_t count = 0;
    if (!check(tact_world_vertex_count(world_, moved, &count))) return;
    positions_.resize(3 * count);
    for (double& x : positions_) x = input_.number();
    const tact_columns columns = positions();
    check(tact_world_set_positions(world_, moved, &columns));
  }

  void set_pose() {
    const tact_body moved = body();
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (input_.byte() % 2 == 1) rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    rotation[input_.byte() % 9] += input_.byte() > 250 ? 1.0 : 0.0;
    const std::array<double, 3> translation{input_.number(), input_.number(), input_.number()};
    check(tact_world_set_pose(world_, moved, rotation.data(), translation.data()));
  }

  void detect() {
    if (!check(tact_world_detect(world_))) return;
    std::size_t contacts = 0;
    std::uint64_t hash = 0, again = 0;
    require(check(tact_report_contacts(world_, &contacts)) && check(tact_report_hash(world_, &hash)),
            "a report is there");
    for (std::size_t i = 0; i <= contacts; ++i) read_contact(i, i < contacts);
    check(tact_world_detect(world_));
    require(check(tact_report_hash(world_, &again)), "a second report is there");
  }

  void read_contact(std::size_t index, bool there) {
    tact_contact contact = TACT_CONTACT_INIT;
    require(check(tact_report_contact(world_, index, &contact)) == there, "a contact is there up to the count");
    if (!there) return;
    require(std::isfinite(contact.depth), "a depth is finite");
    const tact_contact_point* points = nullptr;
    std::size_t count = 0;
    require(check(tact_contact_points(world_, index, &points, &count)), "a contact has points");
    for (std::size_t i = 0; i < count; ++i) require(std::isfinite(points[i].gap), "a gap is finite");
    for (std::size_t i = 0; i < contact.patch_count; ++i) {
      tact_patch patch = TACT_PATCH_INIT;
      require(check(tact_contact_patch(world_, index, i, &patch)), "a patch is there up to the count");
    }
  }

  void motion() {
    tact_motion_options options = TACT_MOTION_OPTIONS_INIT;
    options.wanted = input_.byte() % 4;
    options.has_distance = options.wanted == 0 && input_.byte() % 4 == 0;
    options.bounds = options.has_distance;
    if (!check(tact_world_detect_motion_by(world_, &options))) return;
    const tact_impact* impacts = nullptr;
    std::size_t count = 0;
    require(check(tact_motion_impacts(world_, &impacts, &count)), "impacts are there");
    for (std::size_t i = 0; i < count; ++i) require(impacts[i].time >= 0 && impacts[i].time <= 1, "a time is 0 to 1");
  }

  void queries() {
    tact_ray ray = TACT_RAY_INIT;
    for (double& x : ray.from) x = input_.number();
    for (double& x : ray.to) x = input_.number();
    tact_ray_hit hit;
    if (check(tact_world_cast_ray(world_, &ray, input_.byte() % 3, &hit)) && hit.facet >= 0)
      require(hit.fraction >= 0 && hit.fraction <= 1, "a fraction is 0 to 1");
    tact_point_query point = TACT_POINT_QUERY_INIT;
    for (double& x : point.point) x = input_.number();
    tact_closest_point closest;
    if (check(tact_world_closest_point(world_, &point, &closest)))
      require(closest.distance >= 0, "a distance is not negative");
    std::array<tact_body, 4> bodies;
    std::size_t count = 0;
    check(tact_world_bodies_containing(world_, &point, bodies.data(), bodies.size(), &count));
    tact_box_query box = TACT_BOX_QUERY_INIT;
    for (double& x : box.lower) x = input_.number();
    for (double& x : box.upper) x = input_.number();
    std::array<tact_facet_of_body, 4> found;
    check(tact_world_overlap_box(world_, &box, found.data(), found.size(), &count));
  }

  void settings() {
    tact_settings settings = TACT_SETTINGS_INIT;
    settings.threads = 1;
    const std::uint8_t flags = input_.byte();
    settings.zones = (flags & 1) != 0;
    settings.patches = (flags & 2) != 0;
    settings.points = (flags & 4) != 0;
    settings.accuracy = input_.byte() % 4;
    settings.direction = input_.byte() % 3;
    check(tact_world_set_settings(world_, &settings));
  }

  void weld() {
    read_mesh();
    const tact_columns vertices = positions(), corners = facets();
    std::vector<double> coordinates(positions_.size());
    tact_welded_mesh mesh = TACT_WELDED_MESH_INIT;
    mesh.positions = coordinates.data();
    if (!check(tact_weld(&vertices, &corners, &mesh))) return;
    require(mesh.vertices + mesh.merged_vertices == static_cast<int>(vertices.count), "no vertex is lost");
  }

  Input& input_;
  tact_world world_ = {0};
  std::vector<tact_body> bodies_;
  std::vector<double> positions_;
  std::vector<int> facets_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  Session session(input);
  while (!input.empty()) session.call();
  return 0;
}
