#include "tests/support/data/unit_queries.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tact::tests {

narrowphase::MovingPolygon UnitQuery::polygon() const {
  const auto& v = vertices;
  return edges ? narrowphase::edge_seen_from({v[0], v[1]}, {v[2], v[3]})
               : narrowphase::facet_seen_from(v[0], {v[1], v[2], v[3]});
}

std::vector<UnitQuery> read_unit_queries(const std::string& folder) {
  std::vector<UnitQuery> queries;
  for (const std::string file : {"edge-edge_0", "edge-edge_1", "vertex-face_0", "vertex-face_1"}) {
    std::ifstream in(folder + "/" + file + ".csv");
    std::string line;
    // Eight rows a query: its vertices at the beginning, then at the end.
    for (std::size_t row = 0; std::getline(in, line); ++row) {
      if (row % 8 == 0) queries.push_back({file + ", query " + std::to_string(row / 8), file[0] == 'e', {}, false});
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream numbers(line);
      double x[6];
      for (double& number : x) numbers >> number;
      numbers >> queries.back().answer;
      if (!numbers) throw std::runtime_error(file + ".csv: row " + std::to_string(row + 1) + " is no row of a query");
      queries.back().vertices[row % 4].at[row % 8 / 4] = {x[0] / x[1], x[2] / x[3], x[4] / x[5]};
    }
  }
  return queries;
}

}  // namespace tact::tests
