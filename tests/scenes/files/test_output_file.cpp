#include <gtest/gtest.h>
#include <sys/stat.h>

#include <sstream>
#include <thread>

#include "scenes/files/file_error.h"
#include "scenes/files/output_file.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public ::testing::Test {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  tests::TemporaryFolder folder_;
  std::ostringstream standard_output_;
  const std::string name_ = (folder_.path() / "report").string();
};

TEST_F(OutputFiles, AppearsWhole) {
  OutputFile file(name_, standard_output_);
  file.stream() << "new" << std::flush;
  EXPECT_FALSE(fs::exists(name_));
  file.finish();
  EXPECT_EQ(tests::contents(name_), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFiles, AnOlderFileStaysUntilThen) {
  folder_.write("report", "old");
  {
    OutputFile file(name_, standard_output_);
    file.stream() << "new" << std::flush;
    EXPECT_EQ(files(), 2u);
  }
  EXPECT_EQ(tests::contents(name_), "old");
  EXPECT_EQ(files(), 1u);
  OutputFile file(name_, standard_output_);
  file.stream() << "new";
  file.finish();
  EXPECT_EQ(tests::contents(name_), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFiles, APrivateFileStaysPrivate) {
  folder_.write("report", "old");
  fs::permissions(name_, fs::perms::owner_read | fs::perms::owner_write);
  OutputFile file(name_, standard_output_);
  file.finish();
  EXPECT_EQ(fs::status(name_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFiles, WhatIsForProgramsThatDieAppearsAtOnce) {
  folder_.write("report", "old");
  {
    OutputFile file(name_, standard_output_, Appears::at_once);
    file.stream() << "new" << std::flush;
    EXPECT_EQ(tests::contents(name_), "new");
  }
  EXPECT_EQ(tests::contents(name_), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFiles, LinksDevicesAndPipesAreWrittenDirectly) {
  const fs::path target = folder_.write("target", "old");
  fs::create_symlink(target, name_);
  OutputFile link(name_, standard_output_);
  link.stream() << "new";
  link.finish();
  EXPECT_TRUE(fs::is_symlink(name_));
  EXPECT_EQ(tests::contents(target), "new");

  OutputFile full("/dev/full", standard_output_);
  full.stream() << "lost";
  EXPECT_THROW(full.finish(), FileError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));

  const std::string pipe = (folder_.path() / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = tests::contents(pipe); });
  {
    OutputFile file(pipe, standard_output_);
    file.stream() << "through";
    file.finish();
  }
  reader.join();
  EXPECT_EQ(read, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(OutputFiles, StandardOutputIsTheStreamGiven) {
  OutputFile file("-", standard_output_);
  file.stream() << "text";
  file.finish();
  EXPECT_EQ(standard_output_.str(), "text");
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFiles, AFolderThatIsMissingIsNamed) {
  try {
    OutputFile(name_ + "/none/x", standard_output_);
    ADD_FAILURE() << "accepted";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()), name_ + "/none/x: cannot be written: No such file or directory");
  }
}

}  // namespace
}  // namespace tact::scenes
