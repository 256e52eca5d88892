#pragma once

#include <filesystem>
#include <string>

namespace plenolab {

/// Keeps runs that work in one folder at the same time from computing the same items: a file of locks, one
/// for each item, that the system releases when a process ends, however it ends. Where a file system has no
/// locks every item counts as free: then two runs do work twice, and results are the same.
class ItemLocks {
 public:
  /// Makes the file below the folder of items.
  explicit ItemLocks(const std::filesystem::path& folder);
  ~ItemLocks();
  ItemLocks(const ItemLocks&) = delete;
  ItemLocks& operator=(const ItemLocks&) = delete;

  /// Takes the lock of an item for this run; false if another run has it.
  bool try_lock(const std::string& key);
  /// Waits until the lock is free and takes it.
  void lock(const std::string& key);
  void unlock(const std::string& key);

 private:
  int descriptor_ = -1;
};

}  // namespace plenolab
