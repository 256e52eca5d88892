#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/parallel.h"
#include "core/base/random.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

TEST(Random, WordsAreThoseOfSplitMix64AndOfAnIndependentComputation) {
  EXPECT_EQ(mix64(0), 0xe220a8397b1dcdafull);  // first output of the published generator for seed 0
  EXPECT_EQ(random_u64(1, 2, 3), 0xd0734750fde362b3ull);
  RandomStream stream(1, 2, 3);
  EXPECT_EQ(stream.next_u64(), 0x12588d809dce88a7ull);
  EXPECT_EQ(stream.next_u64(), 0xdd034ea7d44e8739ull);
}

TEST(Random, UnitNumbersAreExactAndBelowOne) {
  EXPECT_EQ(unit_float(~0ull), 1.0f - 0x1p-24f);
  EXPECT_EQ(unit_double(~0ull), 1.0 - 0x1p-53);
  EXPECT_EQ(unit_float(0), 0.0f);
  EXPECT_EQ(unit_float(0xd0734750fde362b3ull), 13660999 * 0x1p-24f);
}

TEST(Random, MeanVarianceAndNeighbourCorrelationAreThoseOfIndependentUniforms) {
  constexpr int kCount = 200000;
  double sum = 0, squares = 0, products = 0, before = 0.5;
  for (int i = 0; i < kCount; ++i) {
    const double v = unit_double(random_u64(5, 6, static_cast<std::uint64_t>(i))) - 0.5;
    sum += v;
    squares += v * v;
    products += v * before;
    before = v;
  }
  EXPECT_NEAR(sum / kCount, 0, 5 * 0.2887 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0 / 12, 0.001);
  EXPECT_NEAR(products / kCount, 0, 0.001);
}

TEST(Parallel, EveryIndexIsVisitedOnceForAnyThreadsAndGrain) {
  for (const int threads : {0, 1, 2, 5})
    for (const int grain : {1, 7, 1000}) {
      std::vector<int> visits(101, 0);
      parallel_for(101, grain, threads, [&](int begin, int end) {
        EXPECT_LE(end - begin, grain);
        for (int i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      EXPECT_EQ(visits, std::vector<int>(101, 1));
    }
}

TEST(Parallel, NothingToDoCallsNothing) {
  for (const int count : {0, -3}) parallel_for(count, 1, 2, [](int, int) { ADD_FAILURE(); });
}

TEST(Parallel, ExceptionsReachTheCaller) {
  for (const int threads : {1, 3})
    EXPECT_THROW(parallel_for(50, 1, threads,
                              [](int begin, int) {
                                if (begin == 31) throw InputError("31");
                              }),
                 InputError);
}

TEST(Parallel, NegativeThreadsAreRefusedAndZeroMeansAll) {
  EXPECT_THROW(resolve_threads(-1), InputError);
  EXPECT_GE(resolve_threads(0), 1);
  EXPECT_EQ(resolve_threads(3), 3);
}

TEST(Parallel, NestedLoopsFinish) {
  std::atomic<int> sum{0};
  parallel_for(8, 1, 2,
               [&](int, int) { parallel_for(8, 1, 2, [&](int begin, int end) { sum += end - begin; }); });
  EXPECT_EQ(sum, 64);
}

TEST(ContentHash, NothingHashesToThePublishedValue) {
  EXPECT_EQ(ContentHash().hex(), "99aa06d3014798d86001c324468d497f");  // XXH3-128 of no bytes
}

TEST(ContentHash, WordBoundariesCountAndBlocksDoNot) {
  ContentHash ab_c, a_bc, whole, pieces;
  ab_c.add("ab");
  ab_c.add("c");
  a_bc.add("a");
  a_bc.add("bc");
  EXPECT_NE(ab_c.hex(), a_bc.hex());
  whole.add_bytes("light field", 11);
  pieces.add_bytes("light", 5);
  pieces.add_bytes(" field", 6);
  EXPECT_EQ(whole.hex(), pieces.hex());
}

TEST(ContentHash, AFileHashesToItsBytes) {
  const TemporaryFolder folder;
  const std::string bytes(3000000, 'x');
  write_text_file(folder.path() / "a", bytes);
  ContentHash hash;
  hash.add_bytes(bytes.data(), bytes.size());
  EXPECT_EQ(hash_file(folder.path() / "a"), hash.hex());
  EXPECT_THROW(hash_file(folder.path() / "b"), InputError);
}

TEST(File, TextComesBackAndFoldersAreMade) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "new" / "deep" / "a.txt";
  write_text_file(path, std::string("a\0\n", 3));
  EXPECT_EQ(read_text_file(path), std::string("a\0\n", 3));
  write_text_file(path, "shorter");
  EXPECT_EQ(read_text_file(path), "shorter");
}

TEST(File, AFailedWriteLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt";
  write_text_file(path, "old");
  EXPECT_THROW(write_atomically(path,
                                [](const fs::path& temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw InputError("disk full");
                                }),
               InputError);
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(File, AWriterThatWritesNothingIsAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_atomically(folder.path() / "a.txt", [](const fs::path&) {}), InputError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(File, TheTemporaryNameKeepsTheExtension) {
  const TemporaryFolder folder;
  write_atomically(folder.path() / "a.exr", [](const fs::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".exr");
    std::ofstream(temporary) << "x";
  });
}

TEST(File, PlacesThatCannotBeWrittenAreNamed) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "file", "x");
  EXPECT_THROW(write_text_file(folder.path() / "file" / "below.txt", "x"), InputError);
  EXPECT_THROW(write_text_file(folder.path(), "x"), InputError);
  EXPECT_THROW(write_text_file("/proc/plenolab.txt", "x"), InputError);
}

TEST(File, AReadOnlyFolderIsAnErrorThatLeavesNothing) {
  if (::geteuid() == 0) GTEST_SKIP() << "nothing is read-only for root";
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "locked");
  fs::permissions(folder.path() / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(write_text_file(folder.path() / "locked" / "a.txt", "x"), InputError);
  EXPECT_TRUE(fs::is_empty(folder.path() / "locked"));
}

TEST(File, MissingFoldersAndOversizedFilesAreRefusedWhenRead) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "a", "12345");
  EXPECT_EQ(read_text_file(folder.path() / "a", 5), "12345");
  EXPECT_THROW(read_text_file(folder.path() / "a", 4), InputError);
  EXPECT_THROW(read_text_file(folder.path() / "b"), InputError);
  EXPECT_THROW(read_text_file(folder.path()), InputError);
}

TEST(File, TemporaryFoldersDisappearWithTheirContents) {
  fs::path path;
  {
    const TemporaryFolder folder;
    path = folder.path();
    write_text_file(path / "a" / "b", "x");
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(Error, AFailedCheckSaysWhereAndWithWhichValues) {
  try {
    PLENOLAB_CHECK(1 + 1 == 3, "sum 2");
    FAIL();
  } catch (const std::logic_error& error) {
    EXPECT_NE(std::string(error.what()).find("1 + 1 == 3 (sum 2)"), std::string::npos) << error.what();
  }
}

TEST(File, ADeviceIsWrittenIntoAndStaysADevice) {
  write_text_file("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(File, ALinkStaysAndTheFileBehindItIsReplaced) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "target.txt", "old");
  std::filesystem::create_symlink("target.txt", folder.path() / "link.txt");
  write_text_file(folder.path() / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.txt"));
  EXPECT_EQ(read_text_file(folder.path() / "target.txt"), "new");
}

}  // namespace
}  // namespace plenolab
