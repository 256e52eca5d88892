// Results of batches are found by a hash of the sources that decide them: the list of these must be whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> words(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before) + before.size();
  std::istringstream in(text.substr(begin, text.find(after, begin) - begin));
  return {std::istream_iterator<std::string>(in), {}};
}

/// Folders and files that cmake/method_sources.cmake hashes.
struct Hashed {
  std::vector<std::string> folders;
  std::set<std::string> stems;  ///< of files in other folders, without extension

  bool has(const std::string& file) const {
    return stems.count(file.substr(0, file.rfind('.'))) > 0 ||
           std::any_of(folders.begin(), folders.end(),
                       [&](const std::string& folder) { return file.starts_with(folder + "/"); });
  }
};

Hashed hashed_sources() {
  const std::string text = text_of(fs::path(PLENOLAB_SOURCE_DIR) / "cmake" / "method_sources.cmake");
  Hashed hashed{words(text, "set(method_folders", ")"), {}};
  for (const std::string& name : words(text, "foreach(name", ")")) hashed.stems.insert("experiments/" + name);
  return hashed;
}

/// What decides no value of an item, or is known by another part of its key.
bool is_left_out(const std::string& file) {
  static const std::vector<std::string> kLeftOut{
      "stimuli/",
      "experiments/reproduce/",  // renderings: known by their keys in the render cache
      "experiments/batch/study",
      "experiments/batch/plan",            // what the key is made of
      "experiments/batch/item_result",     // how results are stored
      "experiments/cli/operator_options",  // settings: in the key as they are resolved
      "experiments/cli/suggest",
      "experiments/cli/checks",
      "experiments/cli/output",  // words
      "experiments/commands",
      "analysis/",        // tables, provenance and times
      "core/synthesis/",  // frames of videos
  };
  return std::any_of(kLeftOut.begin(), kLeftOut.end(),
                     [&](const std::string& start) { return file.starts_with(start); });
}

std::vector<std::string> includes_of(const std::string& file) {
  static const std::regex pattern(R"re(#\s*include\s+"([^"]+)")re");
  const std::string text = text_of(fs::path(PLENOLAB_SOURCE_DIR) / file);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern); it != std::sregex_iterator(); ++it)
    found.push_back((*it)[1]);
  return found;
}

/// All that the file reaches by includes, with the .cpp beside each header.
std::set<std::string> reached_from(const std::string& start) {
  std::set<std::string> reached;
  std::vector<std::string> open{start};
  while (!open.empty()) {
    const std::string file = open.back();
    open.pop_back();
    if (is_left_out(file) || !fs::exists(fs::path(PLENOLAB_SOURCE_DIR) / file) ||
        !reached.insert(file).second)
      continue;
    for (const std::string& include : includes_of(file)) open.push_back(include);
    if (file.ends_with(".h")) open.push_back(file.substr(0, file.size() - 2) + ".cpp");
  }
  return reached;
}

TEST(MethodSources, HoldAllThatTheResultOfAnItemComesFrom) {
  const Hashed hashed = hashed_sources();
  const std::set<std::string> reached = reached_from("experiments/batch/measure.cpp");
  EXPECT_GT(reached.size(), 100u) << "the include pattern no longer matches the sources";
  for (const char* known : {"experiments/score.cpp", "experiments/batch/input.cpp", "metrics/tmqi.cpp"})
    EXPECT_EQ(reached.count(known), 1u) << known;
  for (const std::string& file : reached)
    EXPECT_TRUE(hashed.has(file)) << file << " decides results of batches and is not in "
                                  << "cmake/method_sources.cmake";
}

TEST(MethodSources, AreAllThere) {
  const Hashed hashed = hashed_sources();
  for (const std::string& folder : hashed.folders)
    EXPECT_TRUE(fs::is_directory(fs::path(PLENOLAB_SOURCE_DIR) / folder)) << folder;
  for (const std::string& stem : hashed.stems)
    EXPECT_TRUE(fs::exists(fs::path(PLENOLAB_SOURCE_DIR) / (stem + ".cpp"))) << stem;
}

}  // namespace
