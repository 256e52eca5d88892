#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/io/exr.h"

namespace plenolab {

/// OpenEXR input stream over bytes in memory that outlive it.
class ExrMemoryStream : public Imf::IStream {
 public:
  ExrMemoryStream(std::span<const std::byte> bytes, const std::string& name);
  bool isMemoryMapped() const override { return true; }
  bool read(char destination[], int count) override;
  char* readMemoryMapped(int count) override;
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  const std::byte* take(int count);
  std::span<const std::byte> bytes_;
  uint64_t position_ = 0;
};

/// Headers of all parts, after checks that bound whatever OpenEXR will allocate for them: attribute sizes
/// against the file's length, the data window against the limits, and the number of chunks against the bytes
/// they need at least.
/// `bytes` may be the beginning of a file of `file_bytes`, if it holds all headers.
std::vector<Imf::Header> scan_exr_headers(std::span<const std::byte> bytes, std::uint64_t file_bytes,
                                          const std::string& name, const ExrLimits& limits);

/// Whether the part holds deep data (several samples a pixel).
bool is_deep(const Imf::Header& header);

}  // namespace plenolab
