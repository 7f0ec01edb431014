#include "scenes/files/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "scenes/files/file_error.h"

namespace tact::scenes {
namespace {

namespace fs = std::filesystem;

// May another file take the place of `path` later? What may not be written now may not be replaced either.
bool replaceable(const std::string& path) {
  std::error_code ignored;
  const fs::file_type type = fs::symlink_status(path, ignored).type();
  return type == fs::file_type::not_found ||
         (type == fs::file_type::regular && access(path.c_str(), W_OK) == 0 && fs::hard_link_count(path, ignored) == 1);
}

}  // namespace

OutputFile::OutputFile(const std::string& path, std::ostream& standard_output, Appears appears)
    : name_(path == "-" ? "standard output" : path), out_(&standard_output) {
  if (path == "-") return;
  constexpr auto kMode = std::ios::binary | std::ios::trunc;
  if (appears == Appears::whole && replaceable(path)) {
    part_ = fmt::format("{}.{}.part", path, getpid());
    file_.open(part_, kMode);
    std::error_code ignored;
    if (fs::exists(path, ignored)) fs::permissions(part_, fs::status(path, ignored).permissions(), ignored);
  }
  if (!file_.is_open()) {
    part_.clear();
    errno = 0;
    file_.open(path, kMode);
  }
  if (!file_.is_open()) throw FileError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  out_ = &file_;
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!part_.empty()) fs::remove(part_, ignored);
}

void OutputFile::finish() {
  out_->flush();
  if (file_.is_open()) file_.close();
  if (!*out_) throw FileError(name_ + ": cannot be written to its end");
  if (part_.empty()) return;
  std::error_code error;
  fs::rename(part_, name_, error);
  if (error && !fs::copy_file(part_, name_, fs::copy_options::overwrite_existing, error)) {
    const std::string part = std::exchange(part_, {}).string();  // stays: it is all that there is
    throw FileError(
        fmt::format("{}: cannot be written: {}; what was to be in it is in {}", name_, error.message(), part));
  }
  if (!error) fs::remove(part_, error);
  part_.clear();
}

}  // namespace tact::scenes
