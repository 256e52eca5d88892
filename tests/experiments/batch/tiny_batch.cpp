#include "tests/experiments/batch/tiny_batch.h"

#include "core/base/file.h"

namespace plenolab {
namespace fs = std::filesystem;

nlohmann::json tiny_batch() {
  return nlohmann::json::parse(R"({
    "format": "plenolab-batch", "version": 1, "repeat": 1,
    "inputs": [{"light_field": "field", "cd_m2_per_unit": 20, "views": "all"}],
    "operators": [{"name": "reinhard02"}, {"name": "bilateral", "settings": {"contrast": 30}}],
    "metrics": ["tmqi"]})");
}

fs::path write_tiny_batch(const fs::path& folder, const nlohmann::json& study) {
  if (!fs::exists(folder / "field")) written_plane(folder / "field");
  write_text_file(folder / "study.json", study.dump(2));
  return folder / "study.json";
}

std::string batch_file(const fs::path& folder, const std::string& name) {
  return read_text_file(folder / name);
}

std::vector<fs::path> item_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "items", error))
    if (entry.path().extension() == ".json" && !entry.path().filename().string().starts_with('.'))
      files.push_back(entry.path());
  return files;
}

std::size_t stored_items(const fs::path& folder) {
  return item_files(folder).size();
}

}  // namespace plenolab
