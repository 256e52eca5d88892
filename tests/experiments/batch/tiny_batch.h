#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/experiments/plane_field.h"

namespace plenolab {

/// A study of a tiny light field (written beside it as "field"), all of its nine views, with two operators.
nlohmann::json tiny_batch();

/// Writes the light field and the study into a folder. Returns the study file.
std::filesystem::path write_tiny_batch(const std::filesystem::path& folder,
                                       const nlohmann::json& study = tiny_batch());

/// The text of a file of a batch.
std::string batch_file(const std::filesystem::path& folder, const std::string& name);

/// Files of items in a folder of results, without their pictures.
std::vector<std::filesystem::path> item_files(const std::filesystem::path& folder);
std::size_t stored_items(const std::filesystem::path& folder);

}  // namespace plenolab
