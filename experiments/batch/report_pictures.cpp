#include "experiments/batch/report_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/io/image_file.h"
#include "experiments/batch/picture.h"
#include "experiments/batch/summary.h"

namespace plenolab {

namespace {

using Stored = std::vector<StoredItem>;

/// What pictures of a report may hold together, so that it stays light.
constexpr std::size_t kMostPictures_px = std::size_t{6} << 20;

/// The pictures of a view of an input, operator by operator; without those that failed or are not there.
ImageComparison contact_sheet(const BatchPlan& plan, const Stored& stored, std::size_t first,
                              const std::filesystem::path& folder) {
  const BatchItem& item = plan.items[first];
  const BatchInput& input = plan.inputs[item.input];
  ImageComparison sheet;
  sheet.caption = title_of(input);
  if (!input.views.empty()) sheet.caption += fmt::format(", view {},{}", item.view.column, item.view.row);
  sheet.alt = sheet.caption;
  for (std::size_t op = 0; op < plan.operators.size(); ++op) {
    if (!stored[first + op].mapped()) continue;
    const std::string remark = exposure_remark(stored[first + op].result);
    try {
      sheet.images.push_back({(remark.empty() ? "" : remark + ": ") + plan.operators[op].title(),
                              read_display_image(picture_file(folder, plan.items[first + op]))});
    } catch (const InputError&) {
      // Somebody took the picture away; the numbers are there all the same.
    }
  }
  return sheet;
}

/// The first item of the middle view of each input.
std::vector<std::size_t> middle_views(const BatchPlan& plan) {
  std::vector<std::size_t> items;
  std::size_t begin = 0;
  for (const BatchInput& input : plan.inputs) {
    const std::size_t views = std::max<std::size_t>(input.views.size(), 1);
    items.push_back(begin + views / 2 * plan.operators.size());
    begin += views * plan.operators.size();
  }
  return items;
}

}  // namespace

ReportSection picture_section(const BatchPlan& plan, const Stored& stored,
                              const std::filesystem::path& folder) {
  ReportSection section{"What was mapped", {}, {}};
  section.blocks.emplace_back(Paragraph{fmt::format(
      "No metric replaces a look at the pictures. The middle view of each input, at most 320 pixels wide; "
      "nearly white is a mean of encoded luma above {}, nearly black one below {}.",
      kNearlyWhite_luma, kNearlyBlack_luma)});
  std::size_t shown_px = 0, left_out = 0;
  for (const std::size_t first : middle_views(plan)) {
    if (shown_px > kMostPictures_px) {
      ++left_out;
      continue;
    }
    ImageComparison sheet = contact_sheet(plan, stored, first, folder);
    for (const ReportImage& image : sheet.images) shown_px += image.image.size();
    if (!sheet.images.empty()) section.blocks.emplace_back(std::move(sheet));
  }
  if (left_out > 0)
    section.blocks.emplace_back(Paragraph{
        fmt::format("Pictures of {} more inputs are in the folder {}, named after the keys of their items.",
                    left_out, kItemsFolder)});
  return section;
}

}  // namespace plenolab
