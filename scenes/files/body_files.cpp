#include "scenes/files/body_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "scenes/commands/counted.h"
#include "scenes/files/mapped_file.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/natural_order.h"
#include "scenes/files/pvd_file.h"

namespace tact::scenes {
namespace {

namespace fs = std::filesystem;

// The frames of what a path names, or of a part of it.
struct Listing {
  fs::path path = {};
  std::vector<fs::path> files = {};
  std::vector<double> times = {};  // of a series
  bool moves = false;
};

bool is_series(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".pvd" || ending == ".PVD";
}

Listing list_folder(const fs::path& path) {
  std::error_code error;
  Listing listing{.path = path, .moves = true};
  fs::directory_iterator entries(path, error);
  while (!error && entries != fs::directory_iterator()) {
    const fs::path& file = entries->path();
    const bool hidden = file.filename().string().starts_with('.');
    if (!hidden && mesh_format(file) && !entries->is_directory(error)) listing.files.push_back(file);
    entries.increment(error);
  }
  if (error) throw FileError(fmt::format("{}: cannot be listed: {}", path.string(), error.message()));
  if (listing.files.empty())
    throw FileError(fmt::format("{}: the folder holds no mesh file ({})", path.string(), kMeshEndings));
  std::sort(listing.files.begin(), listing.files.end(), [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().native(), b.filename().native());
  });
  return listing;
}

std::vector<Listing> list_series(const fs::path& path) {
  if (!fs::exists(path)) throw FileError(path.string() + ": no such file or folder");
  const MappedFile file(path);
  std::vector<Listing> listings;
  for (PvdPart& part : parse_pvd(file.bytes(), path)) {
    const bool moves = part.files.size() > 1;
    listings.push_back({.path = path, .files = std::move(part.files), .times = std::move(part.times), .moves = moves});
  }
  return listings;
}

std::vector<Listing> list_files(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return {list_folder(path)};
  if (is_series(path)) return list_series(path);
  return {{.path = path, .files = {path}}};
}

// The name of "seq", "seq/", "../seq/." and, in it, ".".
std::string base_name(const fs::path& path) {
  fs::path clean = path.lexically_normal();
  if (!clean.has_filename()) clean = clean.parent_path();
  if (clean == "." || clean.filename() == "..") clean = fs::absolute(path).lexically_normal();
  if (!clean.has_filename()) clean = clean.parent_path();
  return clean.has_filename() ? clean.filename().string() : path.string();
}

// Gives out names, each once.
class Names {
 public:
  std::string unique(const std::string& name) {
    int& number = numbers_[name];
    std::string result;
    do {
      ++number;
      result = number == 1 ? name : fmt::format("{}#{}", name, number);
    } while (!taken_.insert(result).second);
    return result;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> numbers_;  // the last one tried for a name
};

void check_frame_counts(const std::vector<Listing>& listings) {
  const auto first = std::find_if(listings.begin(), listings.end(), [](const Listing& l) { return l.moves; });
  for (auto other = first; other != listings.end(); ++other) {
    if (!other->moves || other->files.size() == first->files.size()) continue;
    throw FileError(fmt::format("{}: {}, but {} holds {}: all folders must hold the same number of frames",
                                other->path.string(),
                                counted(static_cast<std::int64_t>(other->files.size()), "mesh file"),
                                first->path.string(), first->files.size()));
  }
}

// Fails unless `mesh`, of `file`, differs from the first frame of `body`, with polygons as the fans `facets`, in its
// positions alone.
void check_topology(const BodyFrames& body, const Eigen::Matrix3Xi& facets, const MeshFile& mesh,
                    const fs::path& file) {
  const std::string first = body.files.front().string();
  const Eigen::Index vertices = body.positions.front().cols();
  if (mesh.positions.cols() != vertices) {
    throw FileError(fmt::format("{}: {} vertices, but the first frame, {}, has {}", file.string(),
                                mesh.positions.cols(), first, vertices));
  }
  if (mesh.facets.cols() != facets.cols()) {
    throw FileError(fmt::format("{}: {} facets, but the first frame, {}, has {}", file.string(), mesh.facets.cols(),
                                first, facets.cols()));
  }
  for (Eigen::Index f = 0; f < mesh.facets.cols(); ++f) {
    if (mesh.facets.col(f) == facets.col(f)) continue;
    throw FileError(
        fmt::format("{}: facet {} has other vertices than in the first frame, {}", file.string(), f, first));
  }
}

void check_bodies(const std::vector<int>& bodies, const MeshFile& mesh, const fs::path& file, const fs::path& first) {
  if (mesh.body_of_vertex == bodies) return;
  throw FileError(
      fmt::format("{}: vertices are of other bodies than in the first frame, {}", file.string(), first.string()));
}

// Adds the warnings of a file; of many the first few.
void add_warnings(std::vector<std::string>&& warnings, BodyFrames& body) {
  constexpr std::size_t kMost = 10;
  for (std::string& warning : warnings) {
    if (body.warnings.size() < kMost) body.warnings.push_back(std::move(warning));
  }
}

// Frames, and of each vertex its body, where the files tell.
struct ReadFrames {
  BodyFrames body;
  std::vector<int> body_of_vertex = {};
};

// The polygons of later frames are split as those of the first. `read` is called after each file.
template <class Read>
ReadFrames read_frames(const Listing& listing, const Read& read) {
  ReadFrames result{.body = {.name = {}, .moves = listing.moves, .times = listing.times}};
  BodyFrames& body = result.body;
  Eigen::Matrix3Xi fans;
  for (std::size_t i = 0; i < listing.files.size(); ++i) {
    MeshFile mesh = read_mesh_file(listing.files[i], i == 0 ? Split::by_shape : Split::fans);
    if (i == 0) {
      body.facets = std::move(mesh.facets);
      fans = std::move(mesh.fans);
      result.body_of_vertex = std::move(mesh.body_of_vertex);
    } else {
      check_topology(body, fans.cols() > 0 ? fans : body.facets, mesh, listing.files[i]);
      check_bodies(result.body_of_vertex, mesh, listing.files[i], listing.files[0]);
    }
    add_warnings(std::move(mesh.warnings), body);
    body.files.push_back(listing.files[i]);
    body.positions.push_back(std::move(mesh.positions));
    read();
  }
  return result;
}

// The bodies of `whole`; body_of_vertex tells which of them each vertex is of.
std::vector<BodyFrames> parts_of(const BodyFrames& whole, const std::vector<std::size_t>& body_of_vertex,
                                 std::size_t count) {
  struct Part {
    std::vector<Eigen::Index> vertices, facets;
  };
  std::vector<Part> parts(count);
  std::vector<int> numbers;  // of each vertex in its body
  for (const std::size_t body : body_of_vertex) {
    std::vector<Eigen::Index>& vertices = parts[body].vertices;
    vertices.push_back(static_cast<Eigen::Index>(numbers.size()));
    numbers.push_back(static_cast<int>(vertices.size()) - 1);
  }
  const auto body_of = [&](int corner) { return body_of_vertex[static_cast<std::size_t>(corner)]; };
  for (Eigen::Index f = 0; f < whole.facets.cols(); ++f) {
    const auto corners = whole.facets.col(f);
    if (body_of(corners[0]) != body_of(corners[1]) || body_of(corners[0]) != body_of(corners[2]))
      throw FileError(fmt::format("{}: facet {} joins vertices of two bodies", whole.files.front().string(), f));
    parts[body_of(corners[0])].facets.push_back(f);
  }
  std::vector<BodyFrames> bodies;
  for (const auto& [vertices, facets] : parts) {
    BodyFrames& body = bodies.emplace_back();
    body.files = whole.files, body.moves = whole.moves, body.times = whole.times;
    body.facets = whole.facets(Eigen::all, facets).unaryExpr([&](int corner) {
      return numbers[static_cast<std::size_t>(corner)];
    });
    body.vertices.assign(vertices.begin(), vertices.end());
    for (const Eigen::Matrix3Xd& positions : whole.positions)
      body.positions.emplace_back(positions(Eigen::all, vertices));
  }
  return bodies;
}

void add_bodies(ReadFrames&& read, const std::string& name, const std::string& short_name,
                std::vector<BodyFrames>& bodies) {
  std::map<int, std::size_t> places;  // of the numbers of bodies
  for (const int body : read.body_of_vertex) places[body] = 0;
  if (places.size() < 2) {
    bodies.push_back(std::move(read.body));
    bodies.back().name = name;
    bodies.back().short_name = short_name;
    return;
  }
  std::size_t count = 0;
  for (auto& [body, place] : places) place = count++;
  std::vector<std::size_t> body_of_vertex;
  body_of_vertex.reserve(read.body_of_vertex.size());
  for (const int body : read.body_of_vertex) body_of_vertex.push_back(places.at(body));
  std::vector<BodyFrames> parts = parts_of(read.body, body_of_vertex, count);
  parts.front().warnings = std::move(read.body.warnings);
  for (const auto& [body, place] : places) {
    parts[place].name = fmt::format("{}:{}", name, body);
    parts[place].short_name = fmt::format("{}:{}", short_name, body);
    bodies.push_back(std::move(parts[place]));
  }
}

// "part#2" for "part.stl#2"; a folder has no ending.
std::string without_ending(const std::string& name, const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return name;
  const std::string file = path.filename().string();
  return path.stem().string() + name.substr(std::min(file.size(), name.size()));
}

}  // namespace

std::vector<BodyFrames> read_bodies(const std::vector<fs::path>& paths, int most_frames, const ReadProgress& progress) {
  std::vector<Listing> listings;
  for (const fs::path& path : paths) {
    std::vector<Listing> parts = list_files(path);
    std::move(parts.begin(), parts.end(), std::back_inserter(listings));
  }
  check_frame_counts(listings);
  std::size_t all = 0;
  for (Listing& listing : listings) {
    listing.files.resize(std::min(listing.files.size(), static_cast<std::size_t>(most_frames)));
    listing.times.resize(std::min(listing.times.size(), static_cast<std::size_t>(most_frames)));
    all += listing.files.size();
  }
  int done = 0;
  const auto tell = [&] { progress(done++, static_cast<int>(all)); };
  tell();
  Names names;
  std::vector<BodyFrames> bodies;
  for (const Listing& listing : listings) {
    const std::string name = names.unique(base_name(listing.path));
    add_bodies(read_frames(listing, tell), name, without_ending(name, listing.path), bodies);
  }
  return bodies;
}

std::vector<double> times_of(const std::vector<BodyFrames>& bodies) {
  for (const BodyFrames& body : bodies) {
    if (body.times.size() > 1) return body.times;
  }
  return {};
}

int frame_count(const std::vector<BodyFrames>& bodies) {
  for (const BodyFrames& body : bodies) {
    if (body.moves) return static_cast<int>(body.files.size());
  }
  return 0;
}

}  // namespace tact::scenes
