#include "experiments/batch/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/image_file.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr int kLargest_px = 320;

/// Mean over the pixels that the box from (x0, y0) to (x1, y1) touches.
Rgb mean_of(const DisplayImage& image, int x0, int y0, int x1, int y1) {
  Rgb sum{};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += image.at(x, y);
  const auto count = static_cast<float>((x1 - x0) * (y1 - y0));
  const auto mean = [&](float value) { return std::clamp(value / count, 0.0f, 1.0f); };
  return {mean(sum.r), mean(sum.g), mean(sum.b)};
}

/// Where pixel `i` of `count` begins among `from` pixels.
int border(int i, int from, int count) {
  return static_cast<int>(static_cast<long long>(i) * from / count);
}

/// A title as the name of a file: letters, digits and what stands in names and settings; "-" for others.
std::string file_name_of(const std::string& title) {
  constexpr std::size_t kLongest = 150;
  std::string name = title.substr(0, kLongest);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("=.,_+").find(c) == std::string::npos)
      c = '-';
  return name;
}

void copy_if_new(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (!fs::exists(from, error) || fs::exists(to, error)) return;
  write_atomically(to, [&](const fs::path& temporary) {
    std::error_code failed;
    fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, failed);
    if (failed) throw InputError(fmt::format("cannot copy {}: {}", from.string(), failed.message()));
  });
}

}  // namespace

DisplayImage small_picture(const DisplayImage& image) {
  const int larger = std::max(image.width(), image.height());
  if (larger <= kLargest_px) return image;
  const auto scaled = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(length) * kLargest_px / larger)));
  };
  DisplayImage small(scaled(image.width()), scaled(image.height()), {});
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      small.at(x, y) =
          mean_of(image, border(x, image.width(), small.width()), border(y, image.height(), small.height()),
                  border(x + 1, image.width(), small.width()), border(y + 1, image.height(), small.height()));
  return small;
}

fs::path picture_file(const fs::path& folder, const BatchItem& item) {
  return folder / kItemsFolder / (item.key + ".png");
}

fs::path image_file(const fs::path& folder, const BatchPlan& plan, const BatchItem& item) {
  return folder / kImagesFolder /
         fmt::format("{}-{}.png", file_name_of(plan.title(item)), item.key.substr(0, 8));
}

void write_pictures(const fs::path& folder, const BatchPlan& plan, const BatchItem& item,
                    const DisplayImage& image) {
  write_display_image(picture_file(folder, item), small_picture(image));
  if (plan.study.keep_images) write_display_image(image_file(folder, plan, item), image);
}

bool has_pictures(const fs::path& folder, const BatchPlan& plan, const BatchItem& item) {
  std::error_code error;
  return fs::exists(picture_file(folder, item), error) &&
         (!plan.study.keep_images || fs::exists(image_file(folder, plan, item), error));
}

void copy_pictures(const fs::path& from, const fs::path& to, const BatchPlan& plan, const BatchItem& item) {
  copy_if_new(picture_file(from, item), picture_file(to, item));
  if (plan.study.keep_images) copy_if_new(image_file(from, plan, item), image_file(to, plan, item));
}

const char* exposure_remark(const ItemResult& result) {
  const Measurement* const luma = result.find("mean_luma");
  if (!luma) return "";
  return luma->value > kNearlyWhite_luma   ? "nearly white"
         : luma->value < kNearlyBlack_luma ? "nearly black"
                                           : "";
}

}  // namespace plenolab
