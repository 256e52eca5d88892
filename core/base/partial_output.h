#pragma once

#include <filesystem>
#include <functional>

namespace plenolab {

/// A file or folder under a temporary name, in which an output is written before it is put in place. It is
/// known to the process, so that remove_partial_outputs() finds it when the process is told to stop; whatever
/// still has the temporary name goes with the object.
class PartialOutput {
 public:
  /// `create` makes the file or folder and returns its path, or only chooses a name that nobody else uses.
  explicit PartialOutput(const std::function<std::filesystem::path()>& create);
  ~PartialOutput();
  PartialOutput(const PartialOutput&) = delete;
  PartialOutput& operator=(const PartialOutput&) = delete;

  /// The temporary name.
  const std::filesystem::path& path() const { return path_; }

  /// Runs `rename`, which puts the output in place: not at all once remove_partial_outputs() has begun.
  void put_in_place(const std::function<void()>& rename) const;

 private:
  std::filesystem::path path_;
};

/// Runs `write` on the temporary name. An InputError that mentions it is thrown on with the final path in its
/// place: that is the name the user gave.
void write_under_temporary_name(const std::filesystem::path& temporary,
                                const std::filesystem::path& final_path,
                                const std::function<void(const std::filesystem::path& temporary)>& write);

/// Removes everything that is partial at this moment and holds up every later attempt to create a partial
/// output or to put one in place, for good: the last act of a process that was told to stop, called from a
/// thread of its own.
void remove_partial_outputs();

}  // namespace plenolab
