#pragma once

#include <gtest/gtest.h>

#include "core/base/file.h"
#include "tests/experiments/batch/tiny_batch.h"

namespace plenolab {

/// The program, run on the tiny batch in a folder of its own.
class BatchCommand : public testing::Test {
 protected:
  /// Runs `batch run` on the study; the exit status must be `status`.
  ProgramResult run(const std::string& name, std::vector<std::string> more = {}, int status = 0) {
    std::vector<std::string> arguments{"batch", "run", study_, "-o", folder(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    return result;
  }
  std::string folder(const std::string& name) const { return parent_.path() / name; }
  std::string csv(const std::string& name) const { return batch_file(folder(name), "results.csv"); }

  TemporaryFolder parent_;
  std::string study_ = write_tiny_batch(parent_.path());
};

}  // namespace plenolab
