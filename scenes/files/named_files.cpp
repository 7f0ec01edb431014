#include "scenes/files/named_files.h"

#include <fmt/format.h>

#include <system_error>

#include "scenes/commands/usage_error.h"

namespace tact::scenes {
namespace {

namespace fs = std::filesystem;

// A file that is not there yet is known by its name alone.
bool are_one(const fs::path& a, const fs::path& b) {
  std::error_code not_there;
  if (fs::equivalent(a, b, not_there)) return true;
  std::error_code unreadable;
  const auto whole_name = [&](const fs::path& file) { return fs::weakly_canonical(fs::absolute(file), unreadable); };
  const fs::path name_a = whole_name(a), name_b = whole_name(b);
  return !unreadable && name_a == name_b;
}

}  // namespace

void NamedFiles::add_input(const fs::path& file) { files_.push_back({"", file}); }

void NamedFiles::add_output(const std::string& option, const fs::path& file) {
  std::error_code not_there;
  if (file.empty() || file == "-" || (fs::exists(file, not_there) && !fs::is_regular_file(file, not_there))) return;
  for (const File& other : files_) {
    if (!are_one(other.path, file)) continue;
    throw UsageError(other.option.empty()
                         ? fmt::format("{}: {} is read, and would be lost", option, file.string())
                         : fmt::format("{} and {}: both would be {}", other.option, option, file.string()));
  }
  files_.push_back({option, file});
}

}  // namespace tact::scenes
