// Who may include whom: scenes, bench, tests -> engine -> narrowphase, broadphase -> engine/base. Never back. Read from
// the #include lines of every source file.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace tact::tests {
namespace {

namespace fs = std::filesystem;

// The folders with sources, and those that each may include besides itself. The longest that fits a file is the file's.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"engine/base", {}},
    {"broadphase", {"engine/base"}},
    {"narrowphase", {"engine/base"}},
    {"engine", {"engine/base", "broadphase", "narrowphase"}},
    {"solver", {"engine/base", "engine"}},
    {"mpi", {"engine/base", "broadphase", "engine"}},
    {"mpi/program", {"engine/base", "engine", "mpi", "scenes"}},
    {"scenes", {"engine/base", "engine", "solver"}},
    {"examples", {"engine/base", "engine", "solver"}},
    {"bench", {"engine/base", "broadphase", "narrowphase", "engine", "solver", "mpi", "scenes", "examples", "tests"}},
    {"tests", {"engine/base", "broadphase", "narrowphase", "engine", "solver", "mpi", "scenes", "examples", "bench"}},
};

bool is_header_of_base(const std::string& path) {
  return fs::exists(fs::path(TACT_SOURCE_DIR) / "engine/base/include" / path);
}

// `tact/solver.h` and the headers below it are beside the engine.
std::string layer_of(const std::string& path) {
  if (path.starts_with("tact/solver") || path.starts_with("engine/include/tact/solver")) return "solver";
  if (path.starts_with("tact/mpi/")) return "mpi";
  if (path.starts_with("mpi/program/")) return "mpi/program";
  if (path.starts_with("tact/")) return is_header_of_base(path) ? "engine/base" : "engine";
  if (path.starts_with("engine/base/")) return "engine/base";
  const std::string top = path.substr(0, path.find('/'));
  return kMayInclude.contains(top) && top != path ? top : "";
}

struct Include {
  std::string file;    // from the project's root
  std::string header;  // as it is written, without brackets or quotes
  bool quoted = false;
};

std::vector<std::string> source_files() {
  std::vector<std::string> files;
  for (const char* folder : {"engine", "broadphase", "narrowphase", "mpi", "scenes", "bench", "tests"}) {
    const fs::path root = fs::path(TACT_SOURCE_DIR) / folder;
    if (!fs::is_directory(root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp" && ending != ".inl") continue;
      files.push_back(fs::relative(entry.path(), TACT_SOURCE_DIR).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> lines_of(const std::string& file) {
  std::ifstream stream(fs::path(TACT_SOURCE_DIR) / file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The first group of each match.
std::set<std::string> names_in(const std::string& file, const std::regex& pattern) {
  std::set<std::string> names;
  for (const std::string& line : lines_of(file)) {
    for (auto found = std::sregex_iterator(line.begin(), line.end(), pattern); found != std::sregex_iterator(); ++found)
      names.insert((*found)[1]);
  }
  return names;
}

std::vector<Include> all_includes() {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::vector<Include> includes;
  for (const std::string& file : source_files()) {
    for (const std::string& line : lines_of(file)) {
      std::smatch match;
      if (std::regex_match(line, match, pattern)) includes.push_back({file, match[2], match[1] == "\""});
    }
  }
  return includes;
}

bool in_engine(const std::string& file) {
  const std::string layer = layer_of(file);
  return layer == "engine" || layer == "engine/base" || layer == "broadphase" || layer == "narrowphase";
}

// Those of mpi/ also include MPI's, and are of a component of their own.
bool is_public(const std::string& file) {
  return file.find("include/tact/") != std::string::npos && !file.starts_with("mpi/");
}

TEST(Layers, IncludeOnlyWhatLiesBelow) {
  const std::vector<Include> includes = all_includes();
  ASSERT_GT(includes.size(), 300u);
  for (const Include& include : includes) {
    const std::string from = layer_of(include.file), to = layer_of(include.header);
    if (to.empty() || to == from) continue;
    const bool draws_with_embree = from == "scenes" && include.header == "narrowphase/pairs/embree.h";
    EXPECT_TRUE(kMayInclude.at(from).contains(to) || draws_with_embree)
        << include.file << " includes " << include.header;
  }
}

// Includes are written from the root, so that a line tells its layer.
TEST(Layers, IncludesAreWrittenFromTheRoot) {
  for (const Include& include : all_includes()) {
    if (!include.quoted) continue;
    EXPECT_FALSE(layer_of(include.header).empty()) << include.file << " includes \"" << include.header << "\"";
    EXPECT_TRUE(fs::exists(fs::path(TACT_SOURCE_DIR) / include.header))
        << include.file << " includes " << include.header;
  }
}

TEST(Layers, PublicHeadersIncludeOnlyEigenTheStandardLibraryAndEachOther) {
  const std::regex allowed("tact/[a-z_]+\\.h|Eigen/Core|[a-z_]+"), of_solver("tact/solver/[a-z_]+\\.h|Eigen/[A-Za-z]+");
  int headers = 0;
  for (const Include& include : all_includes()) {
    if (!is_public(include.file)) continue;
    ++headers;
    EXPECT_TRUE(!include.quoted &&
                (std::regex_match(include.header, allowed) ||
                 (layer_of(include.file) == "solver" && std::regex_match(include.header, of_solver))))
        << include.file << " includes " << include.header;
  }
  EXPECT_GT(headers, 10);
}

TEST(Layers, OpenMpStandsInOneHeader) {
  const std::regex pragma(R"(^\s*#\s*pragma\s+omp\b.*|.*_Pragma\s*\(\s*"omp.*|^\s*#\s*include\s*<omp\.h>.*)");
  std::set<std::string> with_openmp;
  for (const std::string& file : source_files()) {
    if (!in_engine(file)) continue;
    for (const std::string& line : lines_of(file)) {
      if (std::regex_match(line, pragma)) with_openmp.insert(file);
    }
  }
  EXPECT_EQ(with_openmp, std::set<std::string>{"engine/base/parallel.h"});
}

TEST(Layers, EmbreeIsKnownToTheNarrowPhaseAlone) {
  const std::string header = "narrowphase/pairs/embree.h";
  int found = 0;
  for (const Include& include : all_includes()) {
    if (!in_engine(include.file)) continue;
    if (include.header.starts_with("embree")) {
      EXPECT_EQ(include.file, header) << include.file << " includes " << include.header;
    } else if (include.header == header) {
      ++found;
      EXPECT_EQ(layer_of(include.file), "narrowphase") << include.file;
      EXPECT_TRUE(include.file.ends_with(".cpp")) << include.file << " spreads Embree to whoever includes it";
    }
  }
  EXPECT_GT(found, 0);
}

// Another processor has other wide numbers, and another C library other last digits: no answer depends on them. Square
// roots, products with one sum, powers of two and roundings to whole numbers are the same everywhere. Pictures are no
// answer.
TEST(Layers, EngineComputesWithDoublesAndSpecifiedFunctionsAlone) {
  const std::regex unspecified(
      R"(\blong double\b|__float128|_Float\d|\b(std::|__builtin_)?(atan2|hypot|cbrt)[lf]?\(|)"
      R"(\b(std::|__builtin_)(a?(cos|sin|tan)h?|pow|exp[2m]?1?|log(2|10|1p)?|erfc?|[lt]gamma)[lf]?\()");
  int read = 0;
  for (const std::string& file : source_files()) {
    if (!in_engine(file) || file.starts_with("engine/debug/")) continue;
    ++read;
    for (const std::string& line : lines_of(file)) {
      const std::string code = line.substr(0, line.find("//"));
      EXPECT_FALSE(std::regex_search(code, unspecified)) << file << ": " << line;
    }
  }
  EXPECT_GT(read, 200);
}

// libc++ before version 15 lacks them, and only a build with it, as that for WebAssembly, would tell.
TEST(Layers, AlgorithmsOverRangesAreThereForOlderStandardLibraries) {
  const std::regex defined(R"(\b(\w+)\(Range&&)"), used(R"(\branges::(\w+))");
  const std::set<std::string> there = names_in("cmake/platforms/early_libcxx.h", defined);
  std::set<std::string> all;
  for (const std::string& file : source_files()) {
    if (!in_engine(file)) continue;
    for (const std::string& name : names_in(file, used)) {
      all.insert(name);
      EXPECT_TRUE(there.contains(name)) << file << " uses std::ranges::" << name << ", which early_libcxx.h has not";
    }
  }
  EXPECT_GT(all.size(), 20u);
}

// Its inline functions are shared with the user's program, which may be compiled for another machine.
TEST(Layers, EigenEndsAtThePublicInterface) {
  for (const Include& include : all_includes()) {
    if (!include.header.starts_with("Eigen/") || !in_engine(include.file)) continue;
    EXPECT_EQ(layer_of(include.file), "engine") << include.file << " includes " << include.header;
  }
}

// What the engine links is Eigen, Embree and OpenMP: no other library's header is included.
TEST(Layers, EngineIncludesNoOtherLibrary) {
  const std::regex standard("[a-z_0-9]+");
  const std::set<std::string> others = {
      "Eigen/Core", "Eigen/Geometry", "omp.h",   "immintrin.h", "xmmintrin.h",      "emmintrin.h",
      "arm_neon.h", "wasm_simd128.h", "cpuid.h", "time.h",      "embree3/rtcore.h", "embree4/rtcore.h"};
  for (const Include& include : all_includes()) {
    if (!in_engine(include.file) || include.quoted || include.header.starts_with("tact/")) continue;
    EXPECT_TRUE(std::regex_match(include.header, standard) || others.contains(include.header))
        << include.file << " includes " << include.header;
  }
}

}  // namespace
}  // namespace tact::tests
