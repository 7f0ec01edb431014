#include <tact/report_arrays.h>

#include <algorithm>
#include <string>

namespace tact {

namespace {

// Throws where an array is neither left out nor of `width` numbers a row.
template <class Number>
void check_size(std::span<Number> array, std::size_t rows, std::size_t width, const char* name) {
  if (array.empty() || array.size() == rows * width) return;
  throw Error(ErrorCode::wrong_size, std::string(name) + " has room for " + std::to_string(array.size()) +
                                         " numbers, not for " + std::to_string(rows * width));
}

template <class Number, class Value>
void put(std::span<Number> array, std::size_t row, Value value) {
  if (!array.empty()) array[row] = static_cast<Number>(value);
}

template <class Number, class Values>
void put_three(std::span<Number> array, std::size_t row, const Values& values) {
  if (!array.empty()) std::copy_n(values.data(), 3, array.begin() + static_cast<std::ptrdiff_t>(3 * row));
}

template <class Number, class Value>
void put_two(std::span<Number> array, std::size_t row, Value first, Value second) {
  if (array.empty()) return;
  array[2 * row] = static_cast<Number>(first);
  array[2 * row + 1] = static_cast<Number>(second);
}

// What points and pairs within reach have in common.
template <class Arrays>
void check_sizes_of_features(const Arrays& arrays, std::size_t rows) {
  check_size(arrays.bodies, rows, 2, "bodies");
  check_size(arrays.contacts, rows, 1, "contacts");
  check_size(arrays.kinds, rows, 1, "kinds");
  check_size(arrays.a_vertices, rows, 3, "a_vertices");
  check_size(arrays.b_vertices, rows, 3, "b_vertices");
  check_size(arrays.a_weights, rows, 3, "a_weights");
  check_size(arrays.b_weights, rows, 3, "b_weights");
  check_size(arrays.normals, rows, 3, "normals");
}

template <class Arrays, class Found>
void put_features(const Arrays& arrays, std::size_t row, const Contact& contact, std::ptrdiff_t number,
                  const Found& found) {
  put_two(arrays.bodies, row, contact.a.index, contact.b.index);
  put(arrays.contacts, row, number);
  put(arrays.kinds, row, found.kind);
  put_three(arrays.a_vertices, row, found.a_vertices);
  put_three(arrays.b_vertices, row, found.b_vertices);
  put_three(arrays.a_weights, row, found.a_weights);
  put_three(arrays.b_weights, row, found.b_weights);
  put_three(arrays.normals, row, found.normal);
}

template <class List>
std::size_t count_in_contacts(const Report& report, const List& list) {
  std::size_t count = 0;
  for (const Contact& contact : report.contacts()) count += list(contact).size();
  return count;
}

FeatureLabels labels_now(const World& world, BodyId body, const std::array<int, 3>& vertices) {
  try {
    return world.labels(body, vertices);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument) throw;
    throw Error(ErrorCode::wrong_order,
                std::string("the report is of facets that have changed since: ") + error.what());
  }
}

std::uint64_t patch_id(const Contact& contact, const ContactPoint& point) {
  const auto patch = static_cast<std::size_t>(point.patch);
  return patch < contact.patches().size() ? contact.patches()[patch].id : 0;
}

}  // namespace

std::size_t point_count(const Report& report) {
  return count_in_contacts(report, [](const Contact& contact) { return contact.points(); });
}

std::size_t reach_pair_count(const Report& report) {
  return count_in_contacts(report, [](const Contact& contact) { return contact.within_reach(); });
}

std::size_t facet_pair_count(const Report& report) {
  return count_in_contacts(report, [](const Contact& contact) { return contact.facet_pairs(); });
}

void copy_points(const Report& report, const PointArrays& arrays) {
  const std::size_t rows = point_count(report);
  check_sizes_of_features(arrays, rows);
  check_size(arrays.gaps, rows, 1, "gaps");
  check_size(arrays.ids, rows, 1, "ids");
  check_size(arrays.patch_ids, rows, 1, "patch_ids");
  check_size(arrays.minima, rows, 1, "minima");
  std::size_t row = 0;
  for (const Contact& contact : report.contacts()) {
    const auto number = &contact - report.contacts().data();
    for (const ContactPoint& point : contact.points()) {
      put_features(arrays, row, contact, number, point);
      put(arrays.gaps, row, point.gap);
      put(arrays.ids, row, point.id);
      put(arrays.patch_ids, row, patch_id(contact, point));
      put(arrays.minima, row, point.minimum);
      ++row;
    }
  }
}

void copy_point_labels(const World& world, const Report& report, const PointLabelArrays& arrays) {
  const std::size_t rows = point_count(report);
  check_size(arrays.a_facets, rows, 1, "a_facets");
  check_size(arrays.b_facets, rows, 1, "b_facets");
  check_size(arrays.a_vertices, rows, 3, "a_vertices");
  check_size(arrays.b_vertices, rows, 3, "b_vertices");
  std::size_t row = 0;
  for (const Contact& contact : report.contacts()) {
    for (const ContactPoint& point : contact.points()) {
      const FeatureLabels a = labels_now(world, contact.a, point.a_vertices),
                          b = labels_now(world, contact.b, point.b_vertices);
      put(arrays.a_facets, row, a.facet);
      put(arrays.b_facets, row, b.facet);
      put_three(arrays.a_vertices, row, a.vertices);
      put_three(arrays.b_vertices, row, b.vertices);
      ++row;
    }
  }
}

void copy_reach_pairs(const Report& report, const ReachPairArrays& arrays) {
  const std::size_t rows = reach_pair_count(report);
  check_sizes_of_features(arrays, rows);
  check_size(arrays.distances, rows, 1, "distances");
  std::size_t row = 0;
  for (const Contact& contact : report.contacts()) {
    const auto number = &contact - report.contacts().data();
    for (const ReachPair& pair : contact.within_reach()) {
      put_features(arrays, row, contact, number, pair);
      put(arrays.distances, row, pair.distance);
      ++row;
    }
  }
}

void copy_facet_pairs(const Report& report, const FacetPairArrays& arrays) {
  const std::size_t rows = facet_pair_count(report);
  check_size(arrays.bodies, rows, 2, "bodies");
  check_size(arrays.contacts, rows, 1, "contacts");
  check_size(arrays.facets, rows, 2, "facets");
  std::size_t row = 0;
  for (const Contact& contact : report.contacts()) {
    const auto number = &contact - report.contacts().data();
    for (const FacetPair& pair : contact.facet_pairs()) {
      put_two(arrays.bodies, row, contact.a.index, contact.b.index);
      put(arrays.contacts, row, number);
      put_two(arrays.facets, row, pair.a, pair.b);
      ++row;
    }
  }
}

void copy_impacts(const MotionReport& report, const ImpactArrays& arrays) {
  const std::size_t rows = report.impacts().size();
  check_size(arrays.bodies, rows, 2, "bodies");
  check_size(arrays.kinds, rows, 1, "kinds");
  check_size(arrays.times, rows, 1, "times");
  check_size(arrays.a_vertices, rows, 3, "a_vertices");
  check_size(arrays.b_vertices, rows, 3, "b_vertices");
  check_size(arrays.stops, rows, 1, "stops");
  std::size_t row = 0;
  for (const Impact& impact : report.impacts()) {
    put_two(arrays.bodies, row, impact.a.index, impact.b.index);
    put(arrays.kinds, row, impact.kind);
    put(arrays.times, row, impact.time);
    put_three(arrays.a_vertices, row, impact.a_vertices);
    put_three(arrays.b_vertices, row, impact.b_vertices);
    put(arrays.stops, row, impact.stops);
    ++row;
  }
}

}  // namespace tact
