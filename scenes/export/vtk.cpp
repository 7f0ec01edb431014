#include "scenes/export/vtk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "scenes/files/file_error.h"

namespace tact::scenes {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

// The arrays of a frame, in the file's order.
struct Arrays {
  std::vector<double> points;
  std::vector<std::int32_t> body_of_point;
  std::vector<double> gap;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::int32_t> body;
  std::vector<std::int32_t> facet;
  std::vector<std::uint8_t> crossing;
};

Arrays arrays_of(std::span<const PictureBody> bodies, std::span<const SurfaceFields> fields) {
  Arrays arrays;
  std::int64_t first_vertex = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const PictureBody& body = bodies[b];
    arrays.points.insert(arrays.points.end(), body.positions.data(), body.positions.data() + body.positions.size());
    arrays.body_of_point.insert(arrays.body_of_point.end(), static_cast<std::size_t>(body.positions.cols()),
                                static_cast<std::int32_t>(b));
    if (!fields.empty()) arrays.gap.insert(arrays.gap.end(), fields[b].gap.begin(), fields[b].gap.end());
    const std::size_t first_facet = arrays.crossing.size();
    for (Eigen::Index f = 0; f < body.facets.cols(); ++f) {
      for (int k = 0; k < 3; ++k) arrays.connectivity.push_back(first_vertex + body.facets(k, f));
      arrays.offsets.push_back(static_cast<std::int64_t>(arrays.connectivity.size()));
      arrays.body.push_back(static_cast<std::int32_t>(b));
      arrays.facet.push_back(static_cast<std::int32_t>(f));
      arrays.crossing.push_back(0);
    }
    for (const int f : body.meeting_facets) arrays.crossing[first_facet + static_cast<std::size_t>(f)] = 1;
    first_vertex += body.positions.cols();
  }
  return arrays;
}

// The header names the place of each array in the block of raw bytes at the file's end: its size as 64 bits, then
// itself.
class File {
 public:
  File(std::size_t points, std::size_t facets) {
    header_ = fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        points, facets);
  }

  void open(std::string_view element) { header_ += fmt::format("<{}>\n", element); }
  void close(std::string_view element) { header_ += fmt::format("</{}>\n", element); }

  template <class T>
  void array(std::string_view type, std::string_view name, const std::vector<T>& values, int components = 1) {
    header_ += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, data_.size());
    const std::uint64_t bytes = values.size() * sizeof(T);
    data_.append(reinterpret_cast<const char*>(&bytes), sizeof(bytes));
    data_.append(reinterpret_cast<const char*>(values.data()), bytes);
  }

  void write(const std::filesystem::path& file) const {
    std::ofstream out(file, std::ios::binary);
    out << header_ << "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    out.write(data_.data(), static_cast<std::streamsize>(data_.size()));
    out << "\n</AppendedData>\n</VTKFile>\n";
    out.close();
    if (!out) throw FileError(file.string() + ": cannot write the file");
  }

 private:
  std::string header_;
  std::string data_;
};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string frame_name(const std::string& name, std::size_t frame) { return fmt::format("{}_{:05}.vtp", name, frame); }

}  // namespace

std::vector<SurfaceFields> surface_fields(const Report& report, const World& world, const std::vector<BodyId>& bodies) {
  std::vector<SurfaceFields> fields;
  std::map<BodyId, SurfaceFields*> of;
  for (const BodyId body : bodies)
    fields.push_back({.gap = std::vector<double>(world.vertex_count(body), std::numeric_limits<double>::quiet_NaN())});
  for (std::size_t i = 0; i < bodies.size(); ++i) of[bodies[i]] = &fields[i];
  const auto note_gap = [&](BodyId body, const std::array<int, 3>& vertices, double gap) {
    for (const int v : vertices) {
      if (v < 0) continue;
      double& least = of.at(body)->gap[static_cast<std::size_t>(v)];
      if (!(least <= gap)) least = gap;  // the first one, too
    }
  };
  for (const Contact& contact : report.contacts()) {
    for (const FacetPair& pair : contact.facet_pairs()) {
      of.at(contact.a)->crossing.push_back(pair.a);
      of.at(contact.b)->crossing.push_back(pair.b);
    }
    for (const ContactPoint& point : contact.points()) {
      note_gap(contact.a, point.a_vertices, point.gap);
      note_gap(contact.b, point.b_vertices, point.gap);
    }
  }
  for (SurfaceFields& one : fields) {
    std::sort(one.crossing.begin(), one.crossing.end());
    one.crossing.erase(std::unique(one.crossing.begin(), one.crossing.end()), one.crossing.end());
  }
  return fields;
}

VtkSeries::VtkSeries(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw FileError(fmt::format("{}: cannot create the folder: {}", folder_.string(), error.message()));
}

std::filesystem::path VtkSeries::index_file() const { return folder_ / (name_ + ".pvd"); }

void VtkSeries::write(std::span<const PictureBody> bodies, double time, std::span<const SurfaceFields> fields) {
  const Arrays arrays = arrays_of(bodies, fields);
  File file(arrays.points.size() / 3, arrays.crossing.size());
  file.open("PointData");
  file.array("Int32", "body", arrays.body_of_point);
  if (!fields.empty()) file.array("Float64", "tact_gap", arrays.gap);
  file.close("PointData");
  file.open("CellData Scalars=\"body\"");
  file.array("Int32", "body", arrays.body);
  file.array("Int32", "facet", arrays.facet);
  file.array("UInt8", "tact_crossing", arrays.crossing);
  file.close("CellData");
  file.open("Points");
  file.array("Float64", "Points", arrays.points, 3);
  file.close("Points");
  file.open("Polys");
  file.array("Int64", "connectivity", arrays.connectivity);
  file.array("Int64", "offsets", arrays.offsets);
  file.close("Polys");
  file.write(folder_ / frame_name(name_, times_.size()));
  times_.push_back(time);
  write_index();
}

void VtkSeries::write_index() const {
  std::ofstream out(index_file());
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
         "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t frame = 0; frame < times_.size(); ++frame) {
    out << fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times_[frame],
                       escaped(frame_name(name_, frame)));
  }
  out << "</Collection>\n</VTKFile>\n";
  out.close();
  if (!out) throw FileError(index_file().string() + ": cannot write the file");
}

}  // namespace tact::scenes
