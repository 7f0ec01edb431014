#include "scenes/pictures/program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <system_error>

#include "scenes/files/file_error.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kOutputKept = 600;  // characters

void check(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

// Where the program's input and output go, and where it runs.
class Surroundings {
 public:
  Surroundings(const std::filesystem::path& folder, const std::filesystem::path& log) {
    check(posix_spawn_file_actions_init(&actions_), "posix_spawn_file_actions_init");
    const auto add = [](int error) { check(error, "posix_spawn_file_actions"); };
    add(posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0));
    add(posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644));
    add(posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO));
    add(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()));
  }
  ~Surroundings() { posix_spawn_file_actions_destroy(&actions_); }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

// The end of a text file, without the spaces at its ends.
std::string last_words(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.size() > kOutputKept) text.erase(0, text.size() - kOutputKept);
  const auto first = text.find_first_not_of(" \n\r\t");
  const auto last = text.find_last_not_of(" \n\r\t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const std::filesystem::path& log) {
  // A log that cannot be opened would look like a program that is missing.
  if (!std::ofstream(log)) throw FileError(log.string() + ": cannot write the file");
  std::vector<std::string> copies(arguments);
  std::vector<char*> pointers;
  for (std::string& argument : copies) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  const Surroundings surroundings(folder, std::filesystem::absolute(log));
  pid_t process = 0;
  const int error = posix_spawnp(&process, pointers[0], surroundings.get(), nullptr, pointers.data(), environ);
  ProgramResult result;
  if (error == 0) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0) {
      if (errno != EINTR) check(errno, "waitpid");
    }
    const bool success = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    result.end = success ? ProgramResult::End::success : ProgramResult::End::failure;
    result.output = last_words(log);
  }
  std::filesystem::remove(log);
  if (error != 0 && error != ENOENT) check(error, arguments[0].c_str());
  return result;
}

}  // namespace tact::scenes
