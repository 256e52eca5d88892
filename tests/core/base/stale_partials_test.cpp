#include "core/base/stale_partials.h"

#include <gtest/gtest.h>

#include "core/base/file.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

void make_old(const fs::path& file) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(2));
}

TEST(StalePartials, OfAKilledProcessGoAndAllElseStays) {
  const TemporaryFolder folder;
  // A temporary file of write_atomically as it is when the process is killed.
  fs::path left;
  write_atomically(folder.path() / "item.json", [&](const fs::path& temporary) {
    write_bytes(temporary, {});
    left = temporary.filename();
  });
  for (const fs::path& name : {left, fs::path(".recent.1-2.partial.json"), fs::path("mine.1-2.partial.json"),
                               fs::path(".notes"), fs::path(".a.partial.json")})
    write_text_file(folder.path() / name, "x");
  fs::create_directory(folder.path() / ".folder.1-2.partial");
  fs::create_symlink("item.json", folder.path() / ".link.1-2.partial.json");
  for (const char* name : {"item.json", "mine.1-2.partial.json", ".notes", ".a.partial.json"})
    make_old(folder.path() / name);
  make_old(folder.path() / left);
  EXPECT_EQ(remove_stale_partials(folder.path()), 1);
  EXPECT_FALSE(fs::exists(folder.path() / left));
  for (const char* name : {"item.json", "mine.1-2.partial.json", ".notes", ".a.partial.json",
                           ".recent.1-2.partial.json", ".folder.1-2.partial", ".link.1-2.partial.json"})
    EXPECT_TRUE(fs::exists(folder.path() / name)) << name;
}

TEST(StalePartials, AFolderThatIsNotThereHasNone) {
  EXPECT_EQ(remove_stale_partials("/nowhere/at/all"), 0);
}

}  // namespace
}  // namespace plenolab
