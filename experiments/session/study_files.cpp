#include "experiments/session/study_files.h"

#include <fmt/format.h>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kStudyFile = "study.json";

/// Adds the files of one image on one display to the study's hashes.
void add_files(StudyDefinition& study, const StudyImage& image, const StimulusFiles& files,
               const fs::path& file) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}: image \"{}\" {}", study_file(file).string(), image.id, why));
  };
  for (const std::string& name : {files.reference, files.test}) {
    const fs::path path = study_folder(file) / name;
    if (!fs::is_regular_file(path))
      refuse(fmt::format("needs the file {}, which is not there", path.string()));
    std::string& hash = study.image_hashes[name];
    if (hash.empty()) hash = hash_file(path);
  }
  const bool same = study.image_hashes[files.reference] == study.image_hashes[files.test];
  if (same && !image.identical)
    refuse(
        fmt::format("has the same content in {} and {}, so that no choice is wrong: replace one, or say "
                    "\"identical\": true if that is meant",
                    files.reference, files.test));
  if (!same && image.identical)
    refuse(fmt::format("is said to be identical, but {} and {} differ", files.reference, files.test));
}

}  // namespace

fs::path study_file(const fs::path& file_or_folder) {
  return fs::is_directory(file_or_folder) ? file_or_folder / kStudyFile : file_or_folder;
}

fs::path study_folder(const fs::path& file_or_folder) {
  const fs::path folder = study_file(file_or_folder).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

StudyDefinition read_study(const fs::path& file) {
  const fs::path path = study_file(file);
  StudyDefinition study = parse_study(read_text_file(path, 4u << 20), path.string());
  for (const StudyBlock& block : study.blocks)
    for (const std::string& id : block.images) {
      const StudyImage& image = study.image(id);
      add_files(study, image, image.on(block.display), file);
    }
  return study;
}

}  // namespace plenolab
