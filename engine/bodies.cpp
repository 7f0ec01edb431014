#include "engine/bodies.h"

#include <algorithm>
#include <limits>

#include "engine/base/parallel.h"

namespace tact {

namespace {

using narrowphase::PositionProblem;

constexpr Eigen::Index kLargestCount = std::numeric_limits<int>::max() / 4;
constexpr char kAxisName[] = {'x', 'y', 'z'};

std::string quoted(const std::string& name) { return "body '" + name + "'"; }

void check_positions(const double* positions, std::size_t count, const std::string& name) {
  const PositionProblem problem = narrowphase::find_position_problem(positions, count, kLargestCoordinate);
  if (problem.kind == PositionProblem::none) return;
  const bool infinite = problem.kind == PositionProblem::non_finite;
  const double value = positions[3 * static_cast<std::size_t>(problem.source_vertex) + static_cast<std::size_t>(problem.axis)];
  throw Error(infinite ? ErrorCode::non_finite_position : ErrorCode::position_out_of_range,
              quoted(name) + ": vertex " + std::to_string(problem.source_vertex) + " has " + kAxisName[problem.axis] + " = " +
                  std::to_string(value) + (infinite ? ", which is not finite" : ", which is larger than 2^300 in size"));
}

void check_facets(const Eigen::Ref<const Eigen::Matrix3Xi>& facets, Eigen::Index vertices, const std::string& name) {
  const int* corner = facets.data();
  for (Eigen::Index i = 0; i < 3 * facets.cols(); ++i) {
    if (corner[i] >= 0 && corner[i] < vertices) continue;
    throw Error(ErrorCode::facet_out_of_range, quoted(name) + ": facet " + std::to_string(i / 3) + " names vertex " +
                                                   std::to_string(corner[i]) + ", but there are " + std::to_string(vertices) +
                                                   " vertices");
  }
}

template <class T>
void make_room(std::vector<T>& vector, std::size_t count) {
  if (vector.capacity() < count) vector.reserve(2 * count);
}

std::span<const double> values(const Eigen::Ref<const Eigen::Matrix3Xd>& m) {
  return {m.data(), static_cast<std::size_t>(m.size())};
}

}  // namespace

BodyId Bodies::add(const BodyDefinition& definition) {
  const auto slot = free_.empty() ? static_cast<std::uint32_t>(slots_.size()) : free_.back();
  const std::string name = definition.name.empty() ? "body " + std::to_string(slot) : definition.name;
  if (slots_.size() >= std::numeric_limits<std::uint32_t>::max() || definition.positions.cols() > kLargestCount ||
      definition.facets.cols() > kLargestCount) {
    throw Error(ErrorCode::too_large, quoted(name) + ": more vertices, facets or bodies than 32-bit indices can number");
  }
  check_positions(definition.positions.data(), static_cast<std::size_t>(definition.positions.cols()), name);
  check_facets(definition.facets, definition.positions.cols(), name);
  const std::span<const int> facets(definition.facets.data(), static_cast<std::size_t>(definition.facets.size()));
  auto body = std::make_unique<Body>(Body{.id = {},
                                          .name = name,
                                          .surface = definition.surface,
                                          .motion = definition.motion,
                                          .facet_count = static_cast<std::size_t>(definition.facets.cols()),
                                          .mesh = {values(definition.positions), facets}});
  // From here on nothing can fail half-way: what may allocate comes first.
  make_room(changed_, slots_.size() + 1);
  make_room(free_, slots_.size() + 1);
  make_room(slots_, slots_.size() + 1);
  boxes_.resize(std::max<std::size_t>(boxes_.size(), slot + 1));
  filters_.resize(std::max<std::size_t>(filters_.size(), slot + 1));
  if (slot == slots_.size()) {
    slots_.emplace_back();
  } else {
    free_.pop_back();
  }
  body->id = {slot, ++slots_[slot].generation, world_};
  boxes_[slot] = body->mesh.box();
  filters_[slot] = {definition.layer, definition.mask, definition.motion == Motion::fixed};
  slots_[slot].body = std::move(body);
  mark_changed(slot);
  ++count_;
  return slots_[slot].body->id;
}

void Bodies::remove(BodyId id) {
  at(id);
  slots_[id.index].body.reset();
  boxes_[id.index] = base::Box{};
  free_.push_back(id.index);
  mark_changed(id.index);
  --count_;
}

Body& Bodies::checked_update(BodyId id, const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  Body& body = writable(id);
  if (body.motion == Motion::fixed) throw Error(ErrorCode::fixed_body, quoted(body.name) + " is fixed: its positions cannot be set");
  if (positions.cols() != body.mesh.source_vertex_count()) {
    throw Error(ErrorCode::wrong_size, quoted(body.name) + " has " + std::to_string(body.mesh.source_vertex_count()) +
                                           " vertices, but " + std::to_string(positions.cols()) + " positions were given");
  }
  check_positions(positions.data(), static_cast<std::size_t>(positions.cols()), body.name);
  return body;
}

void Bodies::set_positions(BodyId id, const Eigen::Ref<const Eigen::Matrix3Xd>& positions, int threads) {
  Body& body = checked_update(id, positions);
  const base::FloatingPointMode mode;
  if (!body.mesh.set_positions(positions.data(), threads)) return;
  boxes_[id.index] = body.mesh.box();
  mark_changed(id.index);
}

void Bodies::set_positions(std::span<const PositionsUpdate> updates, int threads) {
  std::vector<Body*> bodies(updates.size());
  base::parallel_for(updates.size(), 16, threads, [&](std::size_t i) {
    bodies[i] = &checked_update(updates[i].body, updates[i].positions);
  });
  std::vector<Body*> sorted = bodies;
  std::sort(sorted.begin(), sorted.end(), [](const Body* a, const Body* b) { return a->id < b->id; });
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) throw Error(ErrorCode::wrong_order, quoted((*twice)->name) + " is named twice in one batch");
  std::vector<char> moved(updates.size(), 0);
  base::parallel_for(updates.size(), 16, threads, [&](std::size_t i) {
    moved[i] = bodies[i]->mesh.set_positions(updates[i].positions.data(), 1);
  });
  for (std::size_t i = 0; i < updates.size(); ++i) {
    if (!moved[i]) continue;
    boxes_[bodies[i]->id.index] = bodies[i]->mesh.box();
    mark_changed(bodies[i]->id.index);
  }
}

bool Bodies::contains(BodyId id) const noexcept {
  return id.world == world_ && id.index < slots_.size() && slots_[id.index].body != nullptr &&
         slots_[id.index].generation == id.generation;
}

const Body& Bodies::at(BodyId id) const {
  const auto text = [&] { return "id (" + std::to_string(id.index) + ", generation " + std::to_string(id.generation) + ")"; };
  if (id.generation == 0) throw Error(ErrorCode::stale_body, text() + " names no body");
  if (id.world != world_) throw Error(ErrorCode::foreign_body, text() + " was given out by another world");
  if (!contains(id)) throw Error(ErrorCode::stale_body, text() + " names a body that was removed");
  return *slots_[id.index].body;
}

std::vector<BodyId> Bodies::ids() const {
  std::vector<BodyId> ids;
  for (const Slot& slot : slots_) {
    if (slot.body) ids.push_back(slot.body->id);
  }
  return ids;
}

void Bodies::mark_changed(std::uint32_t slot) {
  if (slots_[slot].changed) return;
  slots_[slot].changed = true;
  changed_.push_back(slot);
}

void Bodies::end_step() {
  for (const std::uint32_t slot : changed_) slots_[slot].changed = false;
  changed_.clear();
}

void Bodies::mark_all_changed() {
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) mark_changed(slot);
}

}  // namespace tact
