#include "core/io/white_luminance.h"

#include <cmath>

#include "core/io/bytes.h"
#include "core/io/exr.h"

namespace plenolab {

std::optional<double> white_luminance(const std::filesystem::path& path) {
  if (lower_extension(path) != ".exr") return std::nullopt;
  for (const ExrPartInfo& part : read_exr_header(path)) {
    const auto white = part.float_attributes.find(kWhiteLuminance);
    if (white != part.float_attributes.end() && white->second > 0 && std::isfinite(white->second))
      return static_cast<double>(white->second);
  }
  return std::nullopt;
}

}  // namespace plenolab
