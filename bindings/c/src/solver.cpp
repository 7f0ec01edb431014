// What compiles Eigen's decompositions stands here alone: a program that calls none of it does not link it.
//
// The header's functions have a name of their own here. A program in C++ may have compiled them for other instructions,
// for which Eigen aligns a Stencil otherwise, and of two functions of one name the linker keeps one.
#define solver solver_for_c
#include <tact/solver.h>
#include <tact/solver/debug_draw.h>

#include "drawer.h"
#include "engine/base/floating_point_mode.h"
#include "handles.h"

namespace tact::c {
namespace {

using solver::Corners, solver::Stencil, solver::Term;

tact_stencil for_c(const Stencil& stencil) {
  tact_stencil result{};
  result.kind = static_cast<std::int32_t>(stencil.kind);
  result.b_first = stencil.b_first;
  std::ranges::copy(stencil.vertices, result.vertices);
  std::copy_n(stencil.weights.data(), 4, result.weights);
  std::copy_n(stencil.normal.data(), 3, result.normal);
  result.gap = stencil.gap;
  result.id = stencil.id;
  return result;
}

// Throws for what no tact_report_stencils() gives, or a vertex that is not below `vertex_count`.
Stencil from_c(const tact_stencil& given, size_t vertex_count) {
  if (given.kind < 0 || given.kind > TACT_STENCIL_EDGE_EDGE)
    throw Failure{TACT_ERROR_INVALID_ARGUMENT, "a stencil has an unknown kind"};
  Stencil stencil{.kind = static_cast<solver::StencilKind>(given.kind),
                  .b_first = given.b_first,
                  .weights = Eigen::Vector4d(given.weights),
                  .normal = Eigen::Vector3d(given.normal),
                  .gap = given.gap,
                  .id = given.id};
  std::ranges::copy(given.vertices, stencil.vertices.begin());
  for (int k = 0; k < stencil.size(); ++k) {
    if (given.vertices[k] < 0 || static_cast<size_t>(given.vertices[k]) >= vertex_count)
      throw Failure{TACT_ERROR_INDEX_OUT_OF_RANGE, "a stencil has a vertex that is not below the count"};
  }
  return stencil;
}

using Values = Eigen::Map<const Eigen::Matrix3Xd>;
Values values_of(const double* numbers, size_t vertex_count) {
  return Values(numbers, 3, static_cast<Eigen::Index>(vertex_count));
}

void write_stencils(const std::vector<Stencil>& found, tact_stencil* stencils, size_t capacity, size_t* count) {
  for (size_t i = 0; i < std::min(capacity, found.size()); ++i) stencils[i] = for_c(found[i]);
  *count = found.size();
}

void write_term(const Term& term, size_t i, const tact_terms& terms) {
  if (terms.values != nullptr) terms.values[i] = term.value;
  if (terms.gradients != nullptr) std::copy_n(term.gradient.data(), 12, terms.gradients + 12 * i);
  if (terms.hessians != nullptr) std::copy_n(term.hessian.data(), 144, terms.hessians + 144 * i);
}

// Writes term(stencil, its number) of each stencil; nothing if one of them is refused.
template <class TermOf>
void fill(const tact_stencil* stencils, size_t count, size_t vertex_count, const tact_terms& terms,
          const TermOf& term_of) {
  const base::FloatingPointMode mode;
  if (count > 0) check_not_null(stencils);
  for (size_t i = 0; i < count; ++i) from_c(stencils[i], vertex_count);
  for (size_t i = 0; i < count; ++i) write_term(term_of(from_c(stencils[i], vertex_count), i), i, terms);
}

// With its Hessian projected, if that is wanted.
Term wanted(const Term& term, const tact_terms& terms) {
  return terms.hessians != nullptr ? solver::projected(term) : term;
}

}  // namespace
}  // namespace tact::c

using tact::c::check_not_null, tact::c::fill, tact::c::guarded, tact::c::values_of, tact::c::wanted;
using tact::solver::gather, tact::solver::Stencil;

extern "C" {

tact_error tact_report_stencils(tact_world world, const int32_t* first_rows, size_t body_count, tact_stencil* stencils,
                                size_t capacity, size_t* count) {
  return tact::c::with_report(world, [&](const tact::Report& report) {
    check_not_null(count);
    if (body_count > 0) check_not_null(first_rows);
    if (capacity > 0) check_not_null(stencils);
    tact::c::write_stencils(tact::solver::stencils(report, {first_rows, body_count}), stencils, capacity, count);
  });
}

tact_error tact_report_stencils_within_reach(tact_world world, const int32_t* first_rows, size_t body_count,
                                             tact_stencil* whole, tact_stencil* closest, size_t capacity,
                                             size_t* count) {
  return tact::c::with_report(world, [&](const tact::Report& report) {
    check_not_null(count);
    if (body_count > 0) check_not_null(first_rows);
    if (capacity > 0) check_not_null(whole, closest);
    const auto found = tact::solver::stencils_within_reach(report, {first_rows, body_count});
    for (size_t i = 0; i < std::min(capacity, found.size()); ++i) {
      whole[i] = tact::c::for_c(found[i].whole);
      closest[i] = tact::c::for_c(found[i].closest);
    }
    *count = found.size();
  });
}

tact_error tact_stencil_reach_barriers(const tact_stencil* whole, const tact_stencil* closest, size_t count,
                                       const double* positions, const double* rest, size_t vertex_count, double reach,
                                       tact_terms terms) {
  return guarded([&] {
    if (vertex_count > 0) check_not_null(positions);
    if (count > 0) check_not_null(closest);
    const auto x = values_of(positions, vertex_count);
    const auto pair_of = [&](const Stencil& all, size_t i) {
      const tact::solver::ReachStencil pair{all, tact::c::from_c(closest[i], vertex_count)};
      for (int k = 0; k < pair.closest.size(); ++k) {
        if (std::ranges::count(all.vertices, pair.closest.vertices[static_cast<size_t>(k)]) == 0)
          throw tact::c::Failure{TACT_ERROR_INVALID_ARGUMENT, "a closest vertex is not of the whole stencil"};
      }
      return pair;
    };
    for (size_t i = 0; whole != nullptr && i < count; ++i) pair_of(tact::c::from_c(whole[i], vertex_count), i);
    fill(whole, count, vertex_count, terms, [&](const Stencil& all, size_t i) {
      const double threshold =
          rest == nullptr ? 0.0 : tact::solver::mollifier_threshold(gather(all, values_of(rest, vertex_count)));
      return wanted(tact::solver::barrier_term(pair_of(all, i), x, reach, threshold), terms);
    });
  });
}

tact_error tact_motion_stencils(tact_world world, const int32_t* first_rows, size_t body_count, const double* begin,
                                const double* end, size_t vertex_count, tact_stencil* stencils, size_t capacity,
                                size_t* count) {
  return tact::c::with_motion(world, [&](const tact::MotionReport& motion) {
    const tact::base::FloatingPointMode mode;
    check_not_null(count);
    if (body_count > 0) check_not_null(first_rows);
    if (vertex_count > 0) check_not_null(begin, end);
    if (capacity > 0) check_not_null(stencils);
    tact::c::write_stencils(tact::solver::impact_stencils(motion.impacts(), {first_rows, body_count},
                                                          values_of(begin, vertex_count), values_of(end, vertex_count)),
                            stencils, capacity, count);
  });
}

tact_error tact_stencil_gap_rates(const tact_stencil* stencils, size_t count, const double* velocities,
                                  size_t vertex_count, double* rates) {
  return guarded([&] {
    if (vertex_count > 0) check_not_null(velocities);
    if (count > 0) check_not_null(rates);
    const auto of_vertices = values_of(velocities, vertex_count);
    fill(stencils, count, vertex_count, {rates, nullptr, nullptr}, [&](const Stencil& stencil, size_t) {
      return tact::solver::Term{.value = tact::solver::gap_rate(stencil, gather(stencil, of_vertices))};
    });
  });
}

tact_error tact_stencil_gaps(const tact_stencil* stencils, size_t count, const double* positions, size_t vertex_count,
                             tact_terms terms) {
  return guarded([&] {
    if (vertex_count > 0) check_not_null(positions);
    const auto x = values_of(positions, vertex_count);
    fill(stencils, count, vertex_count, terms,
         [&](const Stencil& stencil, size_t) { return tact::solver::gap_of(stencil, gather(stencil, x)).distance; });
  });
}

tact_error tact_stencil_barriers(const tact_stencil* stencils, size_t count, const double* positions,
                                 const double* rest, size_t vertex_count, double reach, tact_terms terms) {
  return guarded([&] {
    if (vertex_count > 0) check_not_null(positions);
    const auto x = values_of(positions, vertex_count);
    fill(stencils, count, vertex_count, terms, [&](const Stencil& stencil, size_t) {
      const double threshold =
          rest == nullptr ? 0.0 : tact::solver::mollifier_threshold(gather(stencil, values_of(rest, vertex_count)));
      return wanted(tact::solver::barrier_term(stencil, gather(stencil, x), reach, threshold), terms);
    });
  });
}

tact_error tact_stencil_penalties(const tact_stencil* stencils, size_t count, const double* positions,
                                  size_t vertex_count, double reach, tact_terms terms) {
  return guarded([&] {
    if (vertex_count > 0) check_not_null(positions);
    const auto x = values_of(positions, vertex_count);
    fill(stencils, count, vertex_count, terms, [&](const Stencil& stencil, size_t) {
      return wanted(tact::solver::penalty_term(stencil, gather(stencil, x), reach), terms);
    });
  });
}

tact_error tact_stencil_friction(const tact_stencil* stencils, size_t count, const double* moved, size_t vertex_count,
                                 const double* limits, double smoothing, tact_terms terms) {
  return guarded([&] {
    if (vertex_count > 0) check_not_null(moved);
    if (count > 0) check_not_null(limits);
    const auto way = values_of(moved, vertex_count);
    fill(stencils, count, vertex_count, terms, [&](const Stencil& stencil, size_t i) {
      return tact::solver::friction_term(stencil, tact::solver::tangents(stencil.normal), gather(stencil, way),
                                         limits[i], smoothing);
    });
  });
}

tact_error tact_stencil_colors(const tact_stencil* stencils, size_t count, size_t moving, int32_t* colors) {
  return guarded([&] {
    if (count > 0) check_not_null(stencils, colors);
    std::vector<Stencil> all;
    for (size_t i = 0; i < count; ++i) all.push_back(tact::c::from_c(stencils[i], INT32_MAX));
    const tact::solver::Coloring coloring =
        tact::solver::color(all, static_cast<int>(std::min<size_t>(moving, INT32_MAX)));
    for (int c = 0; c < coloring.count(); ++c)
      for (const int s : coloring.of(c)) colors[s] = c;
  });
}

tact_error tact_stencil_debug_draw(const tact_stencil* stencils, size_t count, const double* positions,
                                   size_t vertex_count, const tact_debug_drawer* drawer, tact_debug_color color) {
  return guarded([&] {
    const tact::base::FloatingPointMode mode;
    tact::c::CDrawer to(drawer);
    if (count > 0) check_not_null(stencils, positions);
    std::vector<Stencil> given;
    for (size_t i = 0; i < count; ++i) given.push_back(tact::c::from_c(stencils[i], vertex_count));
    tact::solver::debug_draw(given, values_of(positions, vertex_count), to, tact::c::color_of(color));
  });
}
}
