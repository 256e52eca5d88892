#include "experiments/batch/item_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "experiments/batch/item_result.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// An item's lock is that of one byte of the (empty) file: its place is made of the first letters of the key,
/// a hash. Two items with one place would wait for each other, and no more than that.
struct flock byte_of(const std::string& key, int type) {
  constexpr int kDigits = 14;
  struct flock range {};
  range.l_type = static_cast<short>(type);
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(std::stoll(key.substr(0, kDigits), nullptr, 16));
  range.l_len = 1;
  return range;
}

}  // namespace

ItemLocks::ItemLocks(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / kItemsFolder, error);
  descriptor_ = ::open((folder / kItemsFolder / ".locks").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
}

ItemLocks::~ItemLocks() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool ItemLocks::try_lock(const std::string& key) {
  struct flock range = byte_of(key, F_WRLCK);
  return ::fcntl(descriptor_, F_OFD_SETLK, &range) == 0 || (errno != EAGAIN && errno != EACCES);
}

void ItemLocks::lock(const std::string& key) {
  struct flock range = byte_of(key, F_WRLCK);
  while (::fcntl(descriptor_, F_OFD_SETLKW, &range) != 0 && errno == EINTR) {
  }
}

void ItemLocks::unlock(const std::string& key) {
  struct flock range = byte_of(key, F_UNLCK);
  ::fcntl(descriptor_, F_OFD_SETLK, &range);
}

}  // namespace plenolab
