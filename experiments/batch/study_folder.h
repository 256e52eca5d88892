#pragma once

#include <filesystem>

namespace plenolab {

/// Makes a folder that of a study, noted in its batch.json; results of items that are there stay. A study is
/// known by its file's path or, if that has another one (on another machine), by the file's bytes. Throws
/// InputError if it is no folder, or holds anything and no batch, and without `force` if it is that of
/// another study.
void claim_study_folder(const std::filesystem::path& folder, const std::filesystem::path& study, bool force);

}  // namespace plenolab
