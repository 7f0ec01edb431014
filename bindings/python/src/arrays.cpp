#include "arrays.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>

namespace tact::python {

namespace {

std::string text_of(py::handle value) { return py::str(value); }
std::string shape_text(const py::array& array) { return text_of(array.attr("shape")); }

py::type_error holds_other_numbers(const py::array& array, const std::string& what, const char* wanted) {
  return py::type_error(what + " holds " + text_of(array.dtype()) + ", not " + wanted);
}

bool is_plain_array(py::handle given) {
  return reinterpret_cast<PyTypeObject*>(py::type::of(given).ptr()) == py::detail::npy_api::get().PyArray_Type_;
}

// Refuses memory that the processor does not read, as DLPack and CUDA's array interface tell.
void check_is_in_host_memory(py::handle given, const std::string& what) {
  const auto refuse = [&](const std::string& device) {
    throw py::type_error(what + " lies in memory of " + device + ", not of the host: copy it there first");
  };
  if (py::hasattr(given, "__dlpack_device__")) {
    const int device = py::cast<int>(py::object(given.attr("__dlpack_device__")())[py::int_(0)]);
    constexpr int kHost = 1, kCudaHost = 3, kRocmHost = 11;  // DLDeviceType
    const char* const names[] = {nullptr, nullptr, "CUDA", nullptr, "OpenCL", nullptr,         nullptr,  "Vulkan",
                                 "Metal", "VPI",   "ROCm", nullptr, nullptr,  "CUDA, managed", "oneAPI", "WebGPU"};
    if (device == kHost || device == kCudaHost || device == kRocmHost) return;
    const bool is_named = device >= 0 && device < static_cast<int>(std::size(names)) && names[device] != nullptr;
    refuse("device " + (is_named ? std::string(names[device]) : std::to_string(device)));
  }
  if (py::hasattr(given, "__cuda_array_interface__")) refuse("device CUDA");
}

// numpy's own way first: it takes buffers, the array protocol and lists. What speaks DLPack alone is taken by that.
py::object as_array(py::handle given) {
  const bool speaks_dlpack_alone = py::hasattr(given, "__dlpack__") && !py::hasattr(given, "__array__") &&
                                   !py::hasattr(given, "__array_interface__") && PyObject_CheckBuffer(given.ptr()) == 0;
  return py::module_::import("numpy").attr(speaks_dlpack_alone ? "from_dlpack" : "asarray")(given);
}

// What numpy makes of it, without masks, which it would drop.
py::array array_from(py::handle given, const std::string& what) {
  if (is_plain_array(given)) return py::reinterpret_borrow<py::array>(given);
  const auto is_masked = [](py::handle one) {
    return py::isinstance<py::array>(one) && py::cast<bool>(py::module_::import("numpy.ma").attr("is_masked")(one));
  };
  bool masked = is_masked(given);
  if (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given)) {
    for (const py::handle row : given) masked = masked || is_masked(row);
  }
  if (masked) throw py::value_error(what + " has masked values: fill them in, or leave them out");
  check_is_in_host_memory(given, what);
  try {
    const py::array array(as_array(given));
    if (array.ndim() == 0) throw py::type_error(what + " is a " + type_name(given) + ", not an array");
    return array;
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw py::value_error(what + " is no array: " + text_of(error.value()));  // rows of different lengths
  }
}

// The fields of a structured array that are a row, in their order; fields of one type, so that none is rounded.
py::array rows_of_fields(const py::array& array, const std::string& what, bool are_coordinates, std::size_t width) {
  const py::list names(array.dtype().attr("names"));
  py::list chosen;
  if (are_coordinates && names.contains("x") && names.contains("y") && names.contains("z")) {
    for (const char* name : {"x", "y", "z"}) chosen.append(name);
  } else if (names.size() == 1 || (!are_coordinates && names.size() == width)) {
    chosen = names;
  } else {
    throw py::type_error(what + " is a structured array with the fields " + text_of(names) +
                         (are_coordinates ? ", not x, y and z"
                          : width == 3    ? ", not three"
                                          : ", not two") +
                         ": pass those that are meant");
  }
  const py::array part(py::object(array[chosen]));
  const py::object fields = part.dtype().attr("fields");
  for (const py::handle name : chosen) {
    if (!fields[name][py::int_(0)].equal(fields[chosen[0]][py::int_(0)]))
      throw py::type_error(what + " is a structured array whose fields have different types: " + text_of(part.dtype()));
  }
  return py::array(py::object(py::module_::import("numpy.lib.recfunctions").attr("structured_to_unstructured")(part)));
}

// An array of rows of `width` numbers.
py::array rows_from(py::handle given, const std::string& what, const char* letter, bool are_coordinates,
                    py::ssize_t width = 3) {
  py::array array = array_from(given, what);
  if (array.dtype().has_fields()) array = rows_of_fields(array, what, are_coordinates, static_cast<std::size_t>(width));
  if (array.ndim() == 1 && array.size() == 0 && !py::isinstance<py::array>(given))  // an empty list
    return py::array_t<int>(std::vector<py::ssize_t>{0, width});
  if (array.ndim() == 2 && array.shape(1) == width) return array;
  std::string message =
      what + " has shape " + shape_text(array) + ", not (" + letter + ", " + std::to_string(width) + ")";
  if (array.ndim() == 2 && array.shape(0) == width) message += ": pass its transpose";
  throw py::value_error(message);
}

// Whether an integer is one of the numbers of `To`.
template <class To, class From>
bool fits(From value) {
  if constexpr (std::is_integral_v<To>) return std::in_range<To>(value);
  constexpr double kBeyond = 2.0 * static_cast<double>(std::uint64_t{1} << (std::numeric_limits<From>::digits - 1));
  const auto rounded = static_cast<double>(value);
  return rounded < kBeyond && static_cast<From>(rounded) == value;
}

// Integers as other numbers; refuse(index, value as text) throws for one that does not fit.
template <class To, class From, class Refuse>
py::array_t<To> converted_from(const py::array& given, const Refuse& refuse) {
  const py::array_t<From, py::array::c_style | py::array::forcecast> from(given);
  py::array_t<To> to(std::vector<py::ssize_t>(from.shape(), from.shape() + from.ndim()));
  To* numbers = to.mutable_data();
  for (py::ssize_t i = 0; i < from.size(); ++i) {
    if (!fits<To>(from.data()[i])) refuse(i, std::to_string(from.data()[i]));
    numbers[i] = static_cast<To>(from.data()[i]);
  }
  return to;
}
template <class To, class Refuse>
py::array_t<To> converted(const py::array& given, const Refuse& refuse) {
  return given.dtype().kind() == 'u' ? converted_from<To, std::uint64_t>(given, refuse)
                                     : converted_from<To, std::int64_t>(given, refuse);
}

bool holds_integers(const py::array& array) { return array.dtype().kind() == 'i' || array.dtype().kind() == 'u'; }
bool holds_floats(const py::array& array) {
  return array.dtype().kind() == 'f' && array.itemsize() <= static_cast<py::ssize_t>(sizeof(double));
}

// Real numbers, each exactly, row by row.
py::array_t<double> doubles_of(const py::array& array, const std::string& what) {
  if (holds_floats(array)) return py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  if (!holds_integers(array)) throw holds_other_numbers(array, what, "numbers that a float64 holds");
  return converted<double>(array, [&](py::ssize_t, const std::string& value) {
    throw py::value_error(what + " holds " + value + ", which no float64 is");
  });
}

// Rows that share numbers, as of a sliding window, are none that the engine reads where they are.
template <class Number>
bool has_whole_rows_of(const py::array& array) {
  const auto size = static_cast<py::ssize_t>(sizeof(Number));
  return py::isinstance<py::array_t<Number>>(array) && array.strides(1) == size &&
         (array.shape(0) < 2 || std::abs(array.strides(0)) >= array.shape(1) * size);
}

py::array checked_positions(py::handle given, const std::string& what) {
  const py::array array = rows_from(given, what, "V", true);
  const bool as_it_is = has_whole_rows_of<double>(array) || has_whole_rows_of<float>(array);
  return as_it_is ? array : doubles_of(array, what);
}

// `one` is what a row is.
py::array checked_rows(py::handle given, const std::string& what, const std::string& one, const char* letter,
                       py::ssize_t width) {
  const py::array array = rows_from(given, what, letter, false, width);
  if (!holds_integers(array)) throw holds_other_numbers(array, what, "integers");
  if (has_whole_rows_of<int>(array)) return array;
  return converted<int>(array, [&](py::ssize_t i, const std::string& value) {
    throw py::value_error(one + " " + std::to_string(i / width) + " names vertex " + value +
                          ", which no body can have");
  });
}

template <class Scalar, int kRows = 3>
Columns<Scalar, kRows> columns_of(const py::array& array, NumberKind kind) {
  return Columns<Scalar, kRows>::of_kind(
      kind, array.data(), static_cast<std::size_t>(array.shape(0)),
      static_cast<std::size_t>(array.strides(0)));  // Columns turns it back: it may be < 0
}

// Of shape (N,).
py::array row_from(py::handle given, const std::string& what) {
  const py::array array = array_from(given, what);
  if (array.ndim() != 1) throw py::value_error(what + " has shape " + shape_text(array) + ", not (N,)");
  return array;
}

// The same as integers; `otherwise` says what one is not that does not fit.
template <class Number>
py::array_t<Number> integers_of(py::handle given, const std::string& what, const char* otherwise) {
  const py::array array = row_from(given, what);
  if (array.size() == 0) return py::array_t<Number>(0);  // of an empty list numpy makes floats
  if (!holds_integers(array)) throw holds_other_numbers(array, what, "integers");
  return converted<Number>(array, [&](py::ssize_t i, const std::string& value) {
    throw py::value_error(what + " holds " + value + " at " + std::to_string(i) + ", " + otherwise);
  });
}

py::array_t<std::uint32_t> bits_of(py::handle given, const std::string& what) {
  return integers_of<std::uint32_t>(given, what, "which is not 0 to 4294967295");
}

template <class Number>
std::span<const Number> all_of(const py::array_t<Number>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

}  // namespace

FeatureSettingsArgument::FeatureSettingsArgument(py::handle rest_offsets, py::handle vertex_labels,
                                                 py::handle facet_labels, py::handle vertex_layers,
                                                 py::handle vertex_masks, py::handle facet_layers,
                                                 py::handle facet_masks, py::handle margins)
    : rest_offsets_(row_argument(rest_offsets, "rest_offsets")),
      margins_(row_argument(margins, "margins")),
      vertex_labels_(bits_of(vertex_labels, "vertex_labels")),
      facet_labels_(bits_of(facet_labels, "facet_labels")),
      vertex_layers_(bits_of(vertex_layers, "vertex_layers")),
      vertex_masks_(bits_of(vertex_masks, "vertex_masks")),
      facet_layers_(bits_of(facet_layers, "facet_layers")),
      facet_masks_(bits_of(facet_masks, "facet_masks")) {}

FeatureSettings FeatureSettingsArgument::settings() const {
  return {all_of(rest_offsets_), all_of(vertex_labels_), all_of(facet_labels_), all_of(vertex_layers_),
          all_of(vertex_masks_), all_of(facet_layers_),  all_of(facet_masks_),  all_of(margins_)};
}

std::string type_name(py::handle of) { return text_of(py::type::of(of).attr("__name__")); }

PositionsArgument::PositionsArgument(py::handle given, const std::string& what)
    : array_(checked_positions(given, what)) {}

Positions PositionsArgument::columns() const {
  return columns_of<double>(array_, array_.itemsize() == sizeof(float) ? NumberKind::float32 : NumberKind::float64);
}

FacetsArgument::FacetsArgument(py::handle given, const std::string& what)
    : array_(checked_rows(given, what, "facet", "F", 3)) {}

Facets FacetsArgument::columns() const { return columns_of<int>(array_, NumberKind::int32); }

EdgesArgument::EdgesArgument(py::handle given) : array_(checked_rows(given, "edges", "edge", "E", 2)) {}

Edges EdgesArgument::columns() const { return columns_of<int, 2>(array_, NumberKind::int32); }

MeshArguments::MeshArguments(py::handle positions, py::handle facets, py::handle vertex_map, py::handle edges,
                             py::handle points, py::handle facet_map)
    : positions_(positions),
      facets_(facets),
      edges_(edges),
      points_(indices_argument(points, "points")),
      vertex_map_(indices_argument(vertex_map, "vertex_map")),
      facet_map_(indices_argument(facet_map, "facet_map")) {}

MeshUpdate MeshArguments::update() const {
  const auto all_of = [](const py::array_t<int>& array) {
    return std::span<const int>(array.data(), static_cast<std::size_t>(array.size()));
  };
  return {.positions = positions_.columns(),
          .facets = facets_.columns(),
          .edges = edges_.columns(),
          .points = all_of(points_),
          .vertex_map = all_of(vertex_map_),
          .facet_map = all_of(facet_map_)};
}

py::array_t<int> indices_argument(py::handle given, const std::string& what) {
  return integers_of<int>(given, what, "which no body can have");
}

py::array_t<std::uint64_t> ids_argument(py::handle given, const std::string& what) {
  return integers_of<std::uint64_t>(given, what, "which is no id");
}

py::array_t<double> row_argument(py::handle given, const std::string& what) {
  return doubles_of(row_from(given, what), what);
}

py::array_t<double> numbers_argument(py::handle given, const std::string& what, const std::vector<py::ssize_t>& shape) {
  const py::array array = array_from(given, what);
  if (!std::equal(array.shape(), array.shape() + array.ndim(), shape.begin(), shape.end()))
    throw py::value_error(what + " has shape " + shape_text(array) + ", not " + text_of(py::tuple(py::cast(shape))));
  return doubles_of(array, what);
}

py::array_t<double> numbers_argument(py::handle given, const std::string& what) {
  return doubles_of(array_from(given, what), what);
}

Eigen::Vector3d vector_argument(py::handle given, const std::string& what) {
  py::array array = array_from(given, what);
  if (array.ndim() == 2 && array.size() == 3) array = array.reshape({3});
  return Eigen::Map<const Eigen::Vector3d>(numbers_argument(array, what, {3}).data());
}

py::array_t<double> vector_of(const Eigen::Vector3d& vector) {
  py::array_t<double> array(3);
  for (py::ssize_t i = 0; i < 3; ++i) array.mutable_at(i) = vector[i];
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace tact::python
