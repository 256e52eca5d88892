#include "core/base/partial_output.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

TEST(PartialOutput, WhatStillHasTheTemporaryNameGoesWithTheObject) {
  const TemporaryFolder folder;
  const fs::path temporary = folder.path() / "partial", final_path = folder.path() / "final";
  const auto create = [&] {
    std::ofstream(temporary) << "x";
    return temporary;
  };
  { const PartialOutput partial(create); }
  EXPECT_FALSE(fs::exists(temporary));
  {
    const PartialOutput partial(create);
    EXPECT_THROW(partial.put_in_place([] { throw InputError("no"); }), InputError);
  }
  EXPECT_FALSE(fs::exists(temporary));
  {
    const PartialOutput partial(create);
    partial.put_in_place([&] { fs::rename(temporary, final_path); });
  }
  EXPECT_TRUE(fs::exists(final_path));
}

TEST(PartialOutput, ErrorsNameTheFinalPathEachTimeTheyMentionTheTemporaryOne) {
  try {
    write_under_temporary_name("/x/.a.partial", "a", [](const fs::path&) {
      throw InputError("/x/.a.partial/b and /x/.a.partial/c");
    });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a/b and a/c");
  }
}

/// What a process that is told to stop does: removes what is partial, and nothing is put in place after that.
[[noreturn]] void stop_while_writing(const fs::path& folder) {
  const PartialOutput partial([&] {
    std::ofstream(folder / "partial") << "half of it";
    return folder / "partial";
  });
  remove_partial_outputs();
  std::thread([&] {
    partial.put_in_place([&] { std::ofstream(folder / "final") << "half of it"; });
  }).detach();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::_exit(fs::exists(folder / "partial") || fs::exists(folder / "final") ? 1 : 0);
}

TEST(PartialOutputDeathTest, NothingIsPutInPlaceOnceAllWasRemoved) {
  const TemporaryFolder folder;
  EXPECT_EXIT(stop_while_writing(folder.path()), ::testing::ExitedWithCode(0), "");
}

TEST(File, AWriteThatFailsHalfwayNamesTheFileAndTheReasonAndLeavesTheOldOne) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt";
  write_text_file(path, "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string message;
  try {
    write_text_file(path, std::string(100000, 'x'));
  } catch (const InputError& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, "cannot write " + path.string() + ": File too large");
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(File, WithoutANameCannotBeWritten) {
  EXPECT_THROW(write_text_file("", "x"), InputError);
}

}  // namespace
}  // namespace plenolab
