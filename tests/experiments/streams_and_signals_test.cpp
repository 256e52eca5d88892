#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

void print_to_full_device() {
  ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO);
}
void print_to_nowhere() {
  ::close(STDOUT_FILENO);
}
void allow_small_files_only() {
  constexpr rlim_t kBytes = 2048;
  const rlimit limit{kBytes, kBytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Streams, OutputThatIsLostIsAFailureWithItsReason) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  for (const std::vector<std::string>& command : {std::vector<std::string>{"scenes"},
                                                  {"scenes", "--json", "-"},
                                                  {"--help"},
                                                  {"--version"},
                                                  {"render", "--help"},
                                                  {"info", field.string()},
                                                  {"evaluate", field.string(), "--csv", "-"}}) {
    expect_one_clear_sentence(run_program(command, print_to_full_device),
                              "cannot write to standard output: No space left on device");
    expect_one_clear_sentence(run_program(command, print_to_nowhere),
                              "cannot write to standard output: Bad file descriptor");
  }
}

TEST(Streams, AFileThatCannotBeWrittenIsNamedWithTheReason) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const std::string blocked = folder.path() / "file" / "below";
  write_text_file(folder.path() / "file", "x");
  const auto synth = [&](const std::string& out) {
    return std::vector<std::string>{"synth", field, "--at", "1,1", "-o", out};
  };
  expect_one_clear_sentence(run_program(synth(blocked + ".exr")), "Not a directory");
  fs::create_directory(folder.path() / "folder.exr");
  expect_one_clear_sentence(run_program(synth(folder.path() / "folder.exr")), "it is a folder");
  expect_one_clear_sentence(run_program(synth("/proc/x.exr")), "cannot write /proc/x.exr: No such file");
  const std::string big = folder.path() / "big.exr";
  expect_one_clear_sentence(run_program(synth(big), allow_small_files_only),
                            "cannot write " + big + ": File too large");
  const std::string frames = folder.path() / "frames";
  expect_one_clear_sentence(
      run_program({"video", field, "--path", "0,1:2,1", "-o", frames}, allow_small_files_only),
      "cannot write " + frames + "/frame_0000.exr: File too large");
  expect_one_clear_sentence(run_program({"scenes", "--json", "/dev/full"}),
                            "cannot write /dev/full: No space left on device");
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"field", "file", "folder.exr"}));
}

/// A render that takes minutes, into folder/out, stopped as soon as its unfinished folder is there.
class LongRender {
 public:
  explicit LongRender(const fs::path& folder)
      : folder_(folder),
        program_({"render", "tunnel", "--preset", "paper", "--threads", "2", "--cache", cache_.path(), "-o",
                  folder / "out"}) {
    using namespace std::chrono_literals;
    for (int i = 0; i < 3000 && names_in(folder).empty(); ++i) std::this_thread::sleep_for(10ms);
    EXPECT_EQ(names_in(folder_).size(), 1u);
  }
  ProgramResult stopped_by(int signal) {
    program_.send(signal);
    return program_.wait();
  }

 private:
  fs::path folder_;
  TemporaryFolder cache_;
  RunningProgram program_;
};

TEST(StopSignals, LeaveNothingUnfinishedAndEndTheProgramAsTheyAlwaysDo) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const ProgramResult result = LongRender(folder.path()).stopped_by(signal);
    EXPECT_EQ(result.status, -signal);
    EXPECT_NE(result.err.find("stopped"), std::string::npos) << result.err;
    EXPECT_TRUE(names_in(folder.path()).empty()) << names_in(folder.path()).front();
  }
}

TEST(StopSignals, ThatAreIgnoredStayIgnored) {
  const TemporaryFolder folder;
  const fs::path field = written_plane(folder.path() / "field");
  const auto before = ::signal(SIGINT, SIG_IGN);  // the program inherits it
  RunningProgram program({"evaluate", field});
  ::signal(SIGINT, before);
  for (int i = 0; i < 5; ++i) program.send(SIGINT);
  EXPECT_EQ(program.wait().status, 0);
}

TEST(StopSignals, WhatAKilledRunLeftIsRemovedByTheNextOne) {
  const TemporaryFolder folder, elsewhere;
  LongRender(folder.path()).stopped_by(SIGKILL);
  const std::vector<std::string> left = names_in(folder.path());
  ASSERT_EQ(left.size(), 1u);
  EXPECT_TRUE(left[0].starts_with(".out.partial-")) << left[0];
  const fs::path field = written_plane(elsewhere.path() / "field");
  const ProgramResult next = run_program({"convert", field, "-o", folder.path() / "out"});
  EXPECT_EQ(next.status, 0) << next.err;
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"out"});
}

}  // namespace
}  // namespace plenolab
