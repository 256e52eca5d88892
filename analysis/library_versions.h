#pragma once

#include <map>
#include <string>

namespace plenolab {

/// Versions of the libraries that the core is built with.
std::map<std::string, std::string> library_versions();

}  // namespace plenolab
