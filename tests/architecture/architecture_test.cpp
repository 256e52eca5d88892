#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

struct Layer {
  std::string folder;
  std::vector<std::string> may_include;
};

// One row a layer; a layer may always include itself. The order of the rows is the order of the build.
const std::vector<Layer>& layers() {
  static const std::vector<Layer> table{
      {"core/base", {}},
      {"core/image", {"core/base"}},
      {"core/io", {"core/base", "core/image"}},
      {"core/lightfield", {"core/base", "core/image", "core/io"}},
      {"core/synthesis", {"core/base", "core/image", "core/io", "core/lightfield"}},
      {"core/tonemap", {"core/base", "core/image", "core/io", "core/lightfield", "core/synthesis"}},
      {"core/lut", {"core/base", "core/image", "core/io"}},
      {"core/display", {"core/base", "core/image"}},
      {"core/reprojection", {"core/base", "core/image", "core/display"}},
      {"core/luminance",
       {"core/base", "core/image", "core/io", "core/lightfield", "core/synthesis", "core/tonemap"}},
      {"metrics", {"core"}},
      {"stimuli", {"core"}},
      {"analysis", {"core"}},
      {"experiments", {"core", "metrics", "stimuli", "analysis"}},
  };
  return table;
}

bool below(const std::string& path, const std::string& folder) {
  return path.rfind(folder + "/", 0) == 0;
}

bool allowed(const Layer& layer, const std::string& include) {
  if (below(include, layer.folder)) return true;
  for (const std::string& folder : layer.may_include)
    if (below(include, folder)) return true;
  return false;
}

struct SourceLine {
  std::string file;
  std::string include;
};

std::vector<fs::path> sources_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") files.push_back(entry.path());
  return files;
}

std::vector<SourceLine> quoted_includes(const std::string& folder) {
  static const std::regex pattern(R"re(^\s*#\s*include\s+"([^"]+)")re");
  std::vector<SourceLine> includes;
  for (const fs::path& file : sources_below(fs::path(PLENOLAB_SOURCE_DIR) / folder)) {
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);)
      if (std::regex_search(line, match, pattern)) includes.push_back({file.string(), match[1]});
  }
  return includes;
}

TEST(Architecture, EveryLayerIncludesOnlyLayersBelowIt) {
  std::size_t seen = 0;
  for (const Layer& layer : layers()) {
    for (const auto& [file, include] : quoted_includes(layer.folder)) {
      if (include.rfind("generated/", 0) == 0 || include.find('/') == std::string::npos) continue;
      ++seen;
      EXPECT_TRUE(allowed(layer, include)) << file << " includes " << include;
    }
  }
  EXPECT_GT(seen, 50u) << "the include pattern no longer matches the sources";
}

TEST(Architecture, EveryFolderOfCoreIsALayerOfTheTable) {
  for (const auto& entry : fs::directory_iterator(fs::path(PLENOLAB_SOURCE_DIR) / "core")) {
    if (!entry.is_directory()) continue;
    const std::string folder = "core/" + entry.path().filename().string();
    EXPECT_TRUE(
        std::any_of(layers().begin(), layers().end(), [&](const Layer& l) { return l.folder == folder; }))
        << folder << " is not in the table of layers";
  }
}

TEST(Architecture, OnlyTheProgramPrints) {
  static const std::regex printing(R"(std::c(out|err)\b|\bprintf\s*\(|fmt::print\b)");
  for (const char* folder : {"core", "metrics", "stimuli", "analysis"}) {
    for (const fs::path& file : sources_below(fs::path(PLENOLAB_SOURCE_DIR) / folder)) {
      std::ifstream in(file);
      for (std::string line; std::getline(in, line);)
        EXPECT_FALSE(std::regex_search(line, printing)) << file << ": " << line;
    }
  }
}

TEST(Architecture, HeadersAreGuardedByPragmaOnce) {
  for (const Layer& layer : layers()) {
    for (const fs::path& file : sources_below(fs::path(PLENOLAB_SOURCE_DIR) / layer.folder)) {
      // Highway compiles *-inl.h once for each instruction set: such files have a guard of their own.
      if (file.extension() != ".h" || file.stem().string().ends_with("-inl")) continue;
      std::ifstream in(file);
      const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
      EXPECT_NE(text.find("#pragma once"), std::string::npos) << file;
    }
  }
}

}  // namespace
