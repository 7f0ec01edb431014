#include "scenes/files/body_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "scenes/commands/counted.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/natural_order.h"

namespace tact::scenes {
namespace {

namespace fs = std::filesystem;

struct Listing {
  std::vector<fs::path> files = {};
  bool is_folder = false;
};

Listing list_files(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {.files = {path}};
  Listing listing{.is_folder = true};
  fs::directory_iterator entries(path, error);
  while (!error && entries != fs::directory_iterator()) {
    const fs::path& file = entries->path();
    const bool hidden = file.filename().string().starts_with('.');
    if (!hidden && mesh_format(file) && !entries->is_directory(error)) listing.files.push_back(file);
    entries.increment(error);
  }
  if (error) throw FileError(fmt::format("{}: cannot be listed: {}", path.string(), error.message()));
  if (listing.files.empty())
    throw FileError(path.string() + ": the folder holds no mesh file (.obj, .off, .ply, .stl)");
  std::sort(listing.files.begin(), listing.files.end(), [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().native(), b.filename().native());
  });
  return listing;
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

void check_frame_counts(const std::vector<fs::path>& paths, const std::vector<Listing>& listings) {
  const auto first = std::find_if(listings.begin(), listings.end(), [](const Listing& l) { return l.is_folder; });
  for (auto other = first; other != listings.end(); ++other) {
    if (!other->is_folder || other->files.size() == first->files.size()) continue;
    throw FileError(fmt::format("{}: {}, but {} holds {}: all folders must hold the same number of frames",
                                paths[other - listings.begin()].string(),
                                counted(static_cast<std::int64_t>(other->files.size()), "mesh file"),
                                paths[first - listings.begin()].string(), first->files.size()));
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

// Adds the warnings of a file; of many the first few.
void add_warnings(std::vector<std::string>&& warnings, BodyFrames& body) {
  constexpr std::size_t kMost = 10;
  for (std::string& warning : warnings) {
    if (body.warnings.size() < kMost) body.warnings.push_back(std::move(warning));
  }
}

// The polygons of later frames are split as those of the first. `read` is called after each file.
template <class Read>
BodyFrames read_frames(std::string name, const Listing& listing, const Read& read) {
  BodyFrames body{.name = std::move(name), .moves = listing.is_folder};
  Eigen::Matrix3Xi fans;
  for (std::size_t i = 0; i < listing.files.size(); ++i) {
    MeshFile mesh = read_mesh_file(listing.files[i], i == 0 ? Split::by_shape : Split::fans);
    if (i == 0) {
      body.facets = std::move(mesh.facets);
      fans = std::move(mesh.fans);
    } else {
      check_topology(body, fans.cols() > 0 ? fans : body.facets, mesh, listing.files[i]);
    }
    add_warnings(std::move(mesh.warnings), body);
    body.files.push_back(listing.files[i]);
    body.positions.push_back(std::move(mesh.positions));
    read();
  }
  return body;
}

}  // namespace

std::vector<BodyFrames> read_bodies(const std::vector<fs::path>& paths, int most_frames, const ReadProgress& progress) {
  std::vector<Listing> listings;
  for (const fs::path& path : paths) listings.push_back(list_files(path));
  check_frame_counts(paths, listings);
  std::size_t all = 0;
  for (Listing& listing : listings) {
    listing.files.resize(std::min(listing.files.size(), static_cast<std::size_t>(most_frames)));
    all += listing.files.size();
  }
  int done = 0;
  const auto tell = [&] { progress(done++, static_cast<int>(all)); };
  tell();
  Names names;
  std::vector<BodyFrames> bodies;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    bodies.push_back(read_frames(names.unique(base_name(paths[i])), listings[i], tell));
  }
  return bodies;
}

int frame_count(const std::vector<BodyFrames>& bodies) {
  for (const BodyFrames& body : bodies) {
    if (body.moves) return static_cast<int>(body.files.size());
  }
  return 0;
}

}  // namespace tact::scenes
