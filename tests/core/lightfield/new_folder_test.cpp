#include "core/lightfield/new_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

std::function<void(const fs::path&)> writer(const std::string& name) {
  return [name](const fs::path& temporary) { write_text_file(temporary / name, name); };
}

std::ptrdiff_t entries(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), {});
}

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(NewFolder, AppearsWholeWithItsParents) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "deep" / "out";
  write_folder_atomically(out / "", [&](const fs::path& temporary) {
    EXPECT_FALSE(fs::exists(out));
    writer("a")(temporary);
  });
  EXPECT_EQ(read_text_file(out / "a"), "a");
  EXPECT_EQ(entries(out.parent_path()), 1);
}

TEST(NewFolder, TakesThePlaceOfAnEmptyFolderAlsoBehindALink) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "real");
  fs::create_directory_symlink("real", folder.path() / "link");
  write_folder_atomically(folder.path() / "link", writer("a"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(read_text_file(folder.path() / "real" / "a"), "a");
}

TEST(NewFolder, ReplacesAFullFolderOnlyWhenAskedTo) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  write_text_file(out / "old" / "a", "a");
  EXPECT_THROW(write_folder_atomically(out, writer("new")), InputError);
  EXPECT_TRUE(fs::exists(out / "old" / "a"));
  write_folder_atomically(out, writer("new"), ExistingFolder::kReplace);
  EXPECT_TRUE(fs::exists(out / "new"));
  EXPECT_FALSE(fs::exists(out / "old"));
  write_folder_atomically(folder.path() / "fresh", writer("new"), ExistingFolder::kReplace);
  EXPECT_TRUE(fs::exists(folder.path() / "fresh" / "new"));
  EXPECT_EQ(entries(folder.path()), 2);
}

TEST(NewFolder, AFailureLeavesNothingAndNamesTheFolderTheUserGave) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  EXPECT_EQ(message_of([&] {
              write_folder_atomically(out, [](const fs::path& temporary) {
                throw InputError("cannot write " + (temporary / "a.exr").string());
              });
            }),
            "cannot write " + (out / "a.exr").string());
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(NewFolder, PlacesThatCannotBeTakenAreRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "file", "x");
  const auto refused = [&](const fs::path& path) {
    bool called = false;
    const std::string message = message_of([&] {
      write_folder_atomically(
          path, [&](const fs::path&) { called = true; }, ExistingFolder::kReplace);
    });
    EXPECT_FALSE(called) << path;
    return message;
  };
  EXPECT_NE(refused(folder.path() / "file").find("not a folder"), std::string::npos);
  EXPECT_NE(refused(folder.path() / "file" / "out").find("cannot create"), std::string::npos);
  EXPECT_NE(refused("").find("without a name"), std::string::npos);
  EXPECT_NE(refused("/").find("root of a file system"), std::string::npos);
  EXPECT_NE(refused("/proc").find("root of a file system"), std::string::npos);
  EXPECT_NE(refused(".").find("folder you work in"), std::string::npos);
  EXPECT_NE(refused(fs::current_path().parent_path()).find("choose another name"), std::string::npos);
}

TEST(NewFolder, WhatAKilledProcessLeftIsRemovedButNotWhatIsStillBeingWritten) {
  const TemporaryFolder folder;
  const fs::path abandoned = folder.path() / ".out.partial-abcdef",
                 busy = folder.path() / ".out.partial-ghijkl",
                 other = folder.path() / ".other.partial-abcdef";
  for (const fs::path& path : {abandoned, busy, other}) write_text_file(path / "a", "a");
  const int lock = ::open(busy.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  write_folder_atomically(folder.path() / "out", writer("a"));
  ::close(lock);
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(busy / "a"));
  EXPECT_TRUE(fs::exists(other / "a"));
}

TEST(NewFolder, TwoAtWorkOnTheSameFolderDoNotDisturbEachOther) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  write_folder_atomically(out, [&](const fs::path& first) {
    write_text_file(first / "first", "1");
    write_folder_atomically(out, writer("second"));
    fs::remove_all(out);
    EXPECT_TRUE(fs::exists(first / "first"));
  });
  EXPECT_TRUE(fs::exists(out / "first"));
  EXPECT_EQ(entries(folder.path()), 1);
}

}  // namespace
}  // namespace plenolab
