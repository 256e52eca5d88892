#pragma once

#include <filesystem>

#include "core/image/image.h"
#include "experiments/batch/item_result.h"

namespace plenolab {

/// Folder of mapped images in full size ("keep_images" of a study), below that of a batch.
inline constexpr const char* kImagesFolder = "images";

/// A mapped image averaged down to at most 320 × 320 pixels; as it is if it is no larger.
DisplayImage small_picture(const DisplayImage& image);

/// Name of an item's small picture: items/KEY.png. It is written before the item's result, so that there is
/// one for every result with a mapped image.
std::filesystem::path picture_file(const std::filesystem::path& folder, const BatchItem& item);

/// Name of an item's image in full size: images/TITLE-KEY.png, with the first letters of its key.
std::filesystem::path image_file(const std::filesystem::path& folder, const BatchPlan& plan,
                                 const BatchItem& item);

/// Writes the pictures that the study asks for.
void write_pictures(const std::filesystem::path& folder, const BatchPlan& plan, const BatchItem& item,
                    const DisplayImage& image);

/// Whether all of them are there.
bool has_pictures(const std::filesystem::path& folder, const BatchPlan& plan, const BatchItem& item);

/// Copies those that are there and not in `to` yet. Throws InputError if one cannot be written.
void copy_pictures(const std::filesystem::path& from, const std::filesystem::path& to, const BatchPlan& plan,
                   const BatchItem& item);

/// Bounds of mean_luma, the mean of encoded luma in [0, 1], beyond which an image is called nearly white or
/// nearly black.
inline constexpr double kNearlyWhite_luma = 0.9, kNearlyBlack_luma = 0.05;

/// "nearly white", "nearly black", or an empty text.
const char* exposure_remark(const ItemResult& result);

}  // namespace plenolab
