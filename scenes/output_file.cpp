#include "scenes/output_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "scenes/file_error.h"

namespace tact::scenes {

OutputFile::OutputFile(const std::string& path, std::ostream& standard_output)
    : name_(path == "-" ? "standard output" : path), out_(&standard_output) {
  if (path == "-") return;
  errno = 0;
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) throw FileError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  out_ = &file_;
}

void OutputFile::finish() {
  out_->flush();
  if (!*out_) throw FileError(name_ + ": cannot be written to its end");
}

}  // namespace tact::scenes
