#include "analysis/library_versions.h"

#include <OpenEXR/OpenEXRConfig.h>
#include <ceres/version.h>
#include <fmt/core.h>
#include <tbb/version.h>
#include <xxhash.h>

#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

namespace plenolab {

std::map<std::string, std::string> library_versions() {
  const auto dotted = [](unsigned version) {
    return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
  };
  return {{"Ceres Solver", CERES_VERSION_STRING},
          {"OpenCV", CV_VERSION},
          {"OpenEXR", OPENEXR_VERSION_STRING},
          {"fmt", dotted(FMT_VERSION)},
          {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                        NLOHMANN_JSON_VERSION_PATCH)},
          {"oneTBB", fmt::format("{}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR)},
          {"xxHash", dotted(XXH_versionNumber())}};
}

}  // namespace plenolab
