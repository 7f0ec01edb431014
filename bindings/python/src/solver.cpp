#include <pybind11/stl.h>
#include <tact/solver.h>
#include <tact/solver/debug_draw.h>

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "drawer.h"
#include "engine/base/floating_point_mode.h"
#include "motion.h"
#include "shared_world.h"

namespace tact::python {

namespace {

using solver::Stencil, solver::Term;
using Terms = std::tuple<py::array_t<double>, py::array_t<double>, py::array_t<double>>;

// The stencils of a report. They are copies.
struct Stencils {
  std::vector<Stencil> all;
  int last = -1;  // the greatest vertex

  std::span<const Stencil> span() const { return all; }
  py::ssize_t count() const { return static_cast<py::ssize_t>(all.size()); }
};

Eigen::Matrix3Xd matrix_of(py::handle given, const std::string& what) {
  const PositionsArgument argument(given, what);
  const Positions values = argument.columns();
  Eigen::Matrix3Xd matrix(3, values.cols());
  for (std::ptrdiff_t i = 0; i < values.cols(); ++i) matrix.col(i) = Eigen::Vector3d(values.column(i).data());
  return matrix;
}

int greatest_vertex(std::span<const Stencil> stencils) {
  int last = -1;
  for (const Stencil& stencil : stencils) last = std::max(last, *std::ranges::max_element(stencil.vertices));
  return last;
}

using FirstRows = std::unordered_map<BodyId, int>;

// The first rows of both bodies of each of `pairs` for which joins_vertices(pair), by their index. Others that are
// given, such as those of bodies that were removed, are of no index.
template <class Pair, class JoinsVertices>
std::vector<int> rows_by_index(std::span<const Pair> pairs, const FirstRows& first_rows,
                               const JoinsVertices& joins_vertices) {
  for (const auto& [body, row] : first_rows)
    if (row < 0)
      throw py::value_error("the first row of the body of index " + std::to_string(body.index) + " is negative");
  std::vector<int> by_index;
  for (const Pair& pair : pairs) {
    if (!joins_vertices(pair)) continue;
    for (const BodyId body : {pair.a, pair.b}) {
      const auto given = first_rows.find(body);
      if (given == first_rows.end())
        throw py::key_error("the body of index " + std::to_string(body.index) + " has no first row");
      if (body.index >= by_index.size()) by_index.resize(body.index + std::size_t{1}, -1);
      by_index[body.index] = given->second;
    }
  }
  return by_index;
}

bool is_with_plane(const ContactPoint& point) {
  return point.kind == FeaturePair::vertex_plane || point.kind == FeaturePair::plane_vertex;
}

Stencils stencils_of(const OfReport<Report>& report, const FirstRows& first_rows) {
  const auto held = report.held();
  const auto has_points = [](const Contact& contact) { return !std::ranges::all_of(contact.points(), is_with_plane); };
  std::vector<Stencil> all = solver::stencils(*held, rows_by_index(held->contacts(), first_rows, has_points));
  const int last = greatest_vertex(all);
  return {std::move(all), last};
}

// Of pairs within reach. Both have as many.
struct ReachStencils {
  Stencils whole, closest;
};

ReachStencils stencils_within_reach_of(const OfReport<Report>& report, const FirstRows& first_rows) {
  const auto held = report.held();
  const auto has_pairs = [](const Contact& contact) { return !contact.within_reach().empty(); };
  ReachStencils result;
  for (const solver::ReachStencil& pair :
       solver::stencils_within_reach(*held, rows_by_index(held->contacts(), first_rows, has_pairs))) {
    result.whole.all.push_back(pair.whole);
    result.closest.all.push_back(pair.closest);
  }
  result.whole.last = greatest_vertex(result.whole.all);
  result.closest.last = greatest_vertex(result.closest.all);
  return result;
}

// Of impacts that stop.
Stencils impact_stencils_of(const MotionArrays& motion, const FirstRows& first_rows, py::handle begin, py::handle end) {
  const std::vector<int> rows =
      rows_by_index(std::span<const Impact>(motion.impacts), first_rows, solver::is_constraint);
  const Eigen::Matrix3Xd from = matrix_of(begin, "begin"), to = matrix_of(end, "end");
  std::vector<Stencil> all = solver::impact_stencils(motion.impacts, rows, from, to);
  const int last = greatest_vertex(all);
  return {std::move(all), last};
}

// A value of three numbers for every vertex of the stencils.
Eigen::Matrix3Xd checked(const Stencils& stencils, py::handle given, const std::string& what) {
  Eigen::Matrix3Xd values = matrix_of(given, what);
  if (values.cols() <= stencils.last)
    throw py::value_error(what + " has " + std::to_string(values.cols()) + " rows, but vertex " +
                          std::to_string(stencils.last) + " is in a stencil");
  return values;
}

enum class Hessians { none, exact, projected };
Hessians exact_if(bool wanted) { return wanted ? Hessians::exact : Hessians::none; }
Hessians projected_if(bool wanted) { return wanted ? Hessians::projected : Hessians::none; }

// term(stencil, its number) of each. The array of Hessians that are not wanted is empty.
template <class TermOf>
Terms terms_of(const Stencils& stencils, Hessians wanted, const TermOf& term_of) {
  const base::FloatingPointMode mode;
  const auto count = static_cast<py::ssize_t>(stencils.all.size());
  const py::ssize_t hessian_count = wanted == Hessians::none ? 0 : count;
  Terms terms{py::array_t<double>(count), py::array_t<double>({count, py::ssize_t{4}, py::ssize_t{3}}),
              py::array_t<double>({hessian_count, py::ssize_t{12}, py::ssize_t{12}})};
  auto& [values, gradients, hessians] = terms;
  double *value = values.mutable_data(), *gradient = gradients.mutable_data(), *hessian = hessians.mutable_data();
  for (std::size_t i = 0; i < stencils.all.size(); ++i, gradient += 12) {
    const Term term = term_of(stencils.all[i], i);
    *value++ = term.value;
    solver::Vector12d::Map(gradient) = term.gradient;
    if (wanted == Hessians::none) continue;
    solver::Matrix12d::Map(hessian) = wanted == Hessians::projected ? solver::projected(term).hessian : term.hessian;
    hessian += 144;
  }
  return terms;
}

Terms gaps(const Stencils& stencils, py::handle positions, bool hessians) {
  const Eigen::Matrix3Xd x = checked(stencils, positions, "positions");
  return terms_of(stencils, exact_if(hessians), [&](const Stencil& stencil, std::size_t) {
    return solver::gap_of(stencil, solver::gather(stencil, x)).distance;
  });
}

py::array_t<double> gap_rates(const Stencils& stencils, py::handle velocities) {
  const Eigen::Matrix3Xd of_vertices = checked(stencils, velocities, "velocities");
  const base::FloatingPointMode mode;
  return column_of<double>(stencils.span(), [&](const Stencil& stencil) {
    return solver::gap_rate(stencil, solver::gather(stencil, of_vertices));
  });
}

Terms barriers(const Stencils& stencils, py::handle positions, double reach, py::handle rest, bool hessians) {
  const Eigen::Matrix3Xd x = checked(stencils, positions, "positions"),
                         unloaded = rest.is_none() ? x : checked(stencils, rest, "rest");
  return terms_of(stencils, projected_if(hessians), [&](const Stencil& stencil, std::size_t) {
    const double threshold = rest.is_none() ? 0.0 : solver::mollifier_threshold(solver::gather(stencil, unloaded));
    return solver::barrier_term(stencil, solver::gather(stencil, x), reach, threshold);
  });
}

Terms reach_barriers(const ReachStencils& pairs, py::handle positions, double reach, py::handle rest, bool hessians) {
  const Eigen::Matrix3Xd x = checked(pairs.whole, positions, "positions"),
                         unloaded = rest.is_none() ? x : checked(pairs.whole, rest, "rest");
  return terms_of(pairs.whole, projected_if(hessians), [&](const Stencil& whole, std::size_t i) {
    const double threshold = rest.is_none() ? 0.0 : solver::mollifier_threshold(solver::gather(whole, unloaded));
    return solver::barrier_term({whole, pairs.closest.all[i]}, x, reach, threshold);
  });
}

Terms penalties(const Stencils& stencils, py::handle positions, double reach, bool hessians) {
  const Eigen::Matrix3Xd x = checked(stencils, positions, "positions");
  return terms_of(stencils, projected_if(hessians), [&](const Stencil& stencil, std::size_t) {
    return solver::penalty_term(stencil, solver::gather(stencil, x), reach);
  });
}

Terms friction(const Stencils& stencils, py::handle moved, py::handle given_limits, double smoothing, bool hessians) {
  const Eigen::Matrix3Xd way = checked(stencils, moved, "moved");
  const py::array_t<double> limits = numbers_argument(given_limits, "limits", {stencils.count()});
  return terms_of(stencils, exact_if(hessians), [&](const Stencil& stencil, std::size_t i) {
    return solver::friction_term(stencil, solver::tangents(stencil.normal), solver::gather(stencil, way),
                                 limits.data()[i], smoothing);
  });
}

void draw(const Stencils& stencils, py::handle positions, py::object drawer, py::handle color) {
  const Eigen::Matrix3Xd x = checked(stencils, positions, "positions");
  PythonDrawer to(std::move(drawer));
  solver::debug_draw(stencils.all, x, to, color.is_none() ? DebugDrawOptions{}.point : py::cast<DebugColor>(color));
}

void check_moving(int moving) {
  if (moving < 0) throw py::value_error("moving is " + std::to_string(moving) + ", not at least 0");
}

py::array_t<int> colors(const Stencils& stencils, int moving) {
  check_moving(moving);
  const solver::Coloring coloring = solver::color(stencils.all, moving);
  py::array_t<int> result(static_cast<py::ssize_t>(stencils.all.size()));
  for (int c = 0; c < coloring.count(); ++c)
    for (const int s : coloring.of(c)) result.mutable_at(s) = c;
  return result;
}

py::array_t<double> effective_masses(const Stencils& stencils, py::handle given) {
  const py::array_t<double> inverse_masses = row_argument(given, "inverse_masses");
  const std::span<const double> all(inverse_masses.data(), static_cast<std::size_t>(inverse_masses.size()));
  return column_of<double>(stencils.span(),
                           [&](const Stencil& stencil) { return solver::effective_mass(stencil, all); });
}

py::array_t<double> add_gradients(const Stencils& stencils, py::handle given, int moving) {
  check_moving(moving);
  const auto gradients = numbers_argument(given, "gradients", {stencils.count(), 4, 3});
  py::array_t<double> sum({static_cast<py::ssize_t>(moving), py::ssize_t{3}});
  Eigen::Map<Eigen::VectorXd> all(sum.mutable_data(), sum.size());
  all.setZero();
  for (std::size_t i = 0; i < stencils.all.size(); ++i)
    solver::add_gradient(stencils.all[i], solver::Vector12d::Map(gradients.data() + 12 * i), all);
  return sum;
}

// Rows, columns and values of the entries that move.
std::tuple<py::array_t<int>, py::array_t<int>, py::array_t<double>> triplets(const Stencils& stencils, py::handle given,
                                                                             int moving) {
  check_moving(moving);
  const auto hessians = numbers_argument(given, "hessians", {stencils.count(), 12, 12});
  std::vector<Eigen::Triplet<double>> found;
  for (std::size_t i = 0; i < stencils.all.size(); ++i)
    solver::append_triplets(stencils.all[i], solver::Matrix12d::Map(hessians.data() + 144 * i), moving, found);
  const std::span<const Eigen::Triplet<double>> entries = found;
  return {column_of<int>(entries, [](const auto& entry) { return entry.row(); }),
          column_of<int>(entries, [](const auto& entry) { return entry.col(); }),
          column_of<double>(entries, [](const auto& entry) { return entry.value(); })};
}

void define_arrays_of(py::class_<Stencils>& stencils) {
  stencils
      .def_property_readonly(
          "kinds",
          [](const Stencils& s) {
            return column_of<std::uint8_t>(s.span(), [](const Stencil& stencil) { return stencil.kind; });
          },
          "(N,) uint8: values of StencilKind")
      .def_property_readonly(
          "vertices",
          [](const Stencils& s) {
            return rows_of<int>(s.span(), 4,
                                [](const Stencil& stencil, int* row) { std::ranges::copy(stencil.vertices, row); });
          },
          "(N, 4): rows of the program's system; -1 fills up")
      .def_property_readonly(
          "weights",
          [](const Stencils& s) {
            return rows_of<double>(
                s.span(), 4, [](const Stencil& stencil, double* row) { Eigen::Vector4d::Map(row) = stencil.weights; });
          },
          "(N, 4): weights of the vertices, those of body a negative: the weighted sum of positions leads from a to b")
      .def_property_readonly(
          "normals", [](const Stencils& s) { return rows_of_three<double>(s.span(), &Stencil::normal); },
          "(N, 3): unit vector from a to b")
      .def_property_readonly(
          "gaps",
          [](const Stencils& s) {
            return column_of<double>(s.span(), [](const Stencil& stencil) { return stencil.gap; });
          },
          "(N,): metres; negative where the surfaces have crossed")
      .def_property_readonly(
          "ids",
          [](const Stencils& s) {
            return column_of<std::uint64_t>(s.span(), [](const Stencil& stencil) { return stencil.id; });
          },
          "(N,) uint64: that of the contact point")
      .def("__len__", [](const Stencils& s) { return s.all.size(); });
}

}  // namespace

void define_solver(py::module_& module) {
  py::enum_<solver::StencilKind> kind(module, "StencilKind",
                                      "The features that a stencil joins, in the order of its vertices.");
  kind.value("point_point", solver::StencilKind::point_point, "two vertices")
      .value("point_edge", solver::StencilKind::point_edge, "a vertex, then two of an edge")
      .value("point_facet", solver::StencilKind::point_facet, "a vertex, then three of a facet")
      .value("edge_edge", solver::StencilKind::edge_edge, "two of an edge of a, then two of an edge of b");
  compare_with_numbers(kind);
  py::class_<Stencils> stencils(module, "Stencils",
                                "The vertices of a contact point and how it depends on them. A row a stencil.");
  define_arrays_of(stencils);
  const auto positions = py::arg("positions"), reach = py::arg("reach"), moving = py::arg("moving");
  const auto hessians = py::arg("hessians") = true;
  stencils
      .def(
          "evaluate_gaps", gaps, positions, py::kw_only(), hessians,
          "the gaps at positions (V, 3): values (N,), gradients (N, 4, 3), Hessians (N, 12, 12), or (0, 12, 12) if they "
          "are not wanted")
      .def("gap_rates", gap_rates, py::arg("velocities"),
           "(N,): how fast gaps grow if vertices have such velocities (V, 3); where they are ways, by how much they "
           "grow")
      .def("barriers", barriers, positions, reach, py::kw_only(), py::arg("rest") = py::none(), hessians,
           "the barriers of gaps below `reach` metres; `rest` (V, 3) for the mollifier of nearly parallel edges. "
           "Hessians are positive semidefinite")
      .def("penalties", penalties, positions, reach, py::kw_only(), hessians,
           "the penalties of gaps below `reach` metres")
      .def("friction", friction, py::arg("moved"), py::arg("limits"), py::arg("smoothing"), py::kw_only(), hessians,
           "the potentials of friction for the ways `moved` (V, 3) of vertices, of at most `limits` (N,) newtons")
      .def("colors", colors, moving, "(N,): stencils of one colour share no vertex below `moving`")
      .def(
          "debug_draw", draw, positions, py::arg("drawer"), py::arg("color") = py::none(),
          "draws stencils where `positions` (V, 3) has their vertices: the edges of both features, a line from a to b, "
          "and the normal, half as long as the features are wide")
      .def("effective_masses", effective_masses, py::arg("inverse_masses"),
           "(N,): the mass that resists a push at the point, kg; infinity if no vertex moves")
      .def("add_gradients", add_gradients, py::arg("gradients"), moving,
           "(moving, 3): the sum of gradients for each vertex below `moving`")
      .def("triplets", triplets, py::arg("hessians"), moving,
           "rows, columns and values of Hessians between vertices below `moving`: for scipy.sparse.coo_matrix");
  py::class_<ReachStencils>(module, "ReachStencils",
                            "A pair within reach, and how it depends on its vertices. A row a pair.")
      .def_readonly("whole", &ReachStencils::whole,
                    "all vertices of both features: what the mollifier of nearly parallel edges depends on")
      .def_readonly("closest", &ReachStencils::closest,
                    "those of the closest features alone: what gap and friction depend on")
      .def("barriers", reach_barriers, positions, reach, py::kw_only(), py::arg("rest") = py::none(), hessians,
           "the barriers of distances below `reach` metres, terms of `whole`; `rest` (V, 3) for the mollifier. "
           "Hessians are positive semidefinite")
      .def("__len__", [](const ReachStencils& pairs) { return pairs.whole.all.size(); });
  module.attr("Report").attr("stencils_within_reach") = py::cpp_function(
      stencils_within_reach_of, py::name("stencils_within_reach"), py::is_method(module.attr("Report")),
      py::arg("first_rows"),
      "the stencils of all pairs within reach, if Settings.within_reach is set; `first_rows` as for stencils()");
  module.attr("MotionReport").attr("stencils") = py::cpp_function(
      impact_stencils_of, py::name("stencils"), py::is_method(module.attr("MotionReport")), py::arg("first_rows"),
      py::arg("begin"), py::arg("end"),
      "the stencils of all impacts that stop, but those with planes, as vertices go straight from `begin` (V, 3) to "
      "`end`; `first_rows` as for Report.stencils()");
  module.attr("Report").attr("stencils") =
      py::cpp_function(stencils_of, py::name("stencils"), py::is_method(module.attr("Report")), py::arg("first_rows"),
                       "the stencils of all points but those with planes; `first_rows` has the row of each body's "
                       "first vertex in the program's system");
}

}  // namespace tact::python
