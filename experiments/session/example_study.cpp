#include "experiments/session/example_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/image/image.h"
#include "core/io/image_file.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kExamplePurpose = 0x6578616d706c6573ull;
constexpr int kLenses = 15, kRows = 8, kSide_px = 81;  // of the display of the thesis (section 3.1)
constexpr int kCentralLens = 7, kCentralRow = 3;       // [4, 8], 1-based row and column
constexpr double kPitch_m = 1e-3, kFov_deg = 19.86;
constexpr int kDiscs = 8;

struct ExampleImage {
  const char* id;
  double nearest_m;  ///< the discs' distances go from here to 2 m
  double band_px;    ///< width of the band beside edges that is wrong in the test image
  bool catch_trial;
};
constexpr std::array kImages{
    ExampleImage{"many", 0.30, 0.4, false},    ExampleImage{"few", 0.45, 0.6, false},
    ExampleImage{"several", 0.35, 0.8, false}, ExampleImage{"curved", 0.25, 1.0, false},
    ExampleImage{"near", 0.12, 4.0, false},    ExampleImage{"catch", 0.30, 30, true}};

struct Disc {
  double x_m, y_m, z_m, radius_m;
  Rgb colour;
};

std::vector<Disc> discs_of(std::size_t image) {
  RandomStream random(1, kExamplePurpose, image);
  std::vector<Disc> discs;
  for (int i = 0; i < kDiscs; ++i) {
    const double share = i / (kDiscs - 1.0);
    const double z_m = kImages[image].nearest_m * std::pow(2.0 / kImages[image].nearest_m, share);
    const double spread = z_m * std::tan(kFov_deg / 2 * std::numbers::pi / 180);
    discs.push_back({(random.next_double() * 2 - 1) * spread,
                     (random.next_double() * 2 - 1) * spread,
                     z_m,
                     spread * (0.15 + 0.2 * random.next_double()),
                     {0.2f + 0.7f * random.next_float(), 0.2f + 0.7f * random.next_float(),
                      0.2f + 0.7f * random.next_float()}});
  }
  return discs;  // nearest first
}

Rgb wall_colour(double u, double v) {
  const bool light = (static_cast<int>(std::floor(u * 14)) + static_cast<int>(std::floor(v * 14))) % 2 == 0;
  return light ? Rgb{0.62f, 0.60f, 0.55f} : Rgb{0.35f, 0.37f, 0.42f};
}

/// The colour seen along a ray from lens position (x, y) with slopes (u, v). In a test image a band of `band`
/// (slope) around nearer discs shows the mean of wall and disc.
Rgb trace(const std::vector<Disc>& discs, double x_m, double y_m, double u, double v, double band) {
  for (const Disc& disc : discs) {
    const double px = x_m + u * disc.z_m - disc.x_m, py = y_m + v * disc.z_m - disc.y_m;
    const double beyond = std::hypot(px, py) - disc.radius_m;
    if (beyond <= 0) {
      const double ring = 0.5 + 0.5 * std::cos(std::atan2(py, px) * 6 + 9 * beyond / disc.radius_m);
      return disc.colour * static_cast<float>(0.6 + 0.4 * ring);
    }
    if (beyond <= band * disc.z_m) return 0.5f * (wall_colour(u, v) + disc.colour);
  }
  return wall_colour(u, v);
}

DisplayImage subimage(const std::vector<Disc>& discs, int lens, int row, double band_px) {
  const double focal_px = kSide_px / 2.0 / std::tan(kFov_deg / 2 * std::numbers::pi / 180);
  const double x_m = (lens - (kLenses - 1) / 2.0) * kPitch_m, y_m = (row - (kRows - 1) / 2.0) * kPitch_m;
  DisplayImage image(kSide_px, kSide_px);
  for (int y = 0; y < kSide_px; ++y)
    for (int x = 0; x < kSide_px; ++x)
      image.at(x, y) = trace(discs, x_m, y_m, (x + 0.5 - kSide_px / 2.0) / focal_px,
                             (y + 0.5 - kSide_px / 2.0) / focal_px, band_px / focal_px);
  return image;
}

DisplayImage light_field(const std::vector<Disc>& discs, double band_px) {
  DisplayImage image(kLenses * kSide_px, kRows * kSide_px);
  for (int row = 0; row < kRows; ++row)
    for (int lens = 0; lens < kLenses; ++lens) {
      const DisplayImage part = subimage(discs, lens, row, band_px);
      for (int y = 0; y < kSide_px; ++y)
        std::copy_n(part.row(y), kSide_px, image.row(row * kSide_px + y) + lens * kSide_px);
    }
  return image;
}

StimulusFiles files_of(const std::string& name, bool monitor) {
  const std::string stem = fmt::format("images/{}{}", name, monitor ? "-monitor" : "");
  return {stem + "-reference.png", stem + "-test.png"};
}

/// Everything of a study but its images.
StudyDefinition frame_of_study() {
  StudyDefinition study;
  study.title = "Light fields by pixel reprojection";
  study.consent = {
      "PLACEHOLDER: replace this text by the one your ethics board agreed to.\n\nYou will compare images for "
      "about ten "
      "minutes. You can stop at any time without giving a reason. Your answers are stored without your name.",
      "PLACEHOLDER: replace this text.\n\nTo be read by a parent or guardian: the participant is under age. "
      "Do you agree "
      "to the participation?"};
  study.questionnaire = {
      {"difficulty", "How hard was it to tell the images apart?", {"very easy", "easy", "hard", "very hard"}},
      {"remarks", "What did you look at? (you may leave this empty)", {}}};
  return study;
}

/// Two blocks with all images and both orders.
void add_blocks(StudyDefinition& study, bool light_fields, int zoom) {
  std::vector<std::string> ids;
  for (const StudyImage& image : study.images) ids.push_back(image.id);
  if (light_fields) study.blocks.push_back({"headset", DisplayKind::kLightField, 0, 1, ids});
  study.blocks.push_back({"monitor", DisplayKind::kMonitor, 0, zoom, ids});
  if (!light_fields) {
    study.orders = {{"only", {"monitor"}}};
    return;
  }
  study.orders = {{"headset-first", {"headset", "monitor"}}, {"monitor-first", {"monitor", "headset"}}};
}

}  // namespace

StudyDefinition example_study() {
  StudyDefinition study = frame_of_study();
  for (const ExampleImage& image : kImages)
    study.images.push_back(
        {image.id, image.catch_trial, files_of(image.id, false), files_of(image.id, true)});
  add_blocks(study, true, 8);
  return study;
}

void write_example_images(const fs::path& folder) {
  for (std::size_t i = 0; i < kImages.size(); ++i) {
    const std::vector<Disc> discs = discs_of(i);
    const StimulusFiles panel = files_of(kImages[i].id, false), monitor = files_of(kImages[i].id, true);
    for (const bool test : {false, true}) {
      const double band_px = test ? kImages[i].band_px : 0;
      write_display_image(folder / (test ? panel.test : panel.reference), light_field(discs, band_px));
      write_display_image(folder / (test ? monitor.test : monitor.reference),
                          subimage(discs, kCentralLens, kCentralRow, band_px));
    }
  }
}

StudyDefinition study_of_images(const fs::path& images, const fs::path& folder) {
  constexpr std::string_view kReference = "-reference.png", kMonitor = "-monitor";
  if (!fs::is_directory(images)) throw InputError(fmt::format("{} is no folder of images", images.string()));
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(images)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(kReference)) continue;
    const std::string name = file.substr(0, file.size() - kReference.size());
    if (!name.ends_with(kMonitor) && fs::exists(images / (name + "-test.png"))) names.push_back(name);
  }
  if (names.empty())
    throw InputError(fmt::format("{} holds no pair NAME-reference.png and NAME-test.png", images.string()));
  std::sort(names.begin(), names.end());
  StudyDefinition study = frame_of_study();
  fs::create_directories(folder / "images");
  for (const std::string& name : names) {
    const bool own = fs::exists(images / (name + "-monitor-reference.png")) &&
                     fs::exists(images / (name + "-monitor-test.png"));
    study.images.push_back(
        {name, name.find("catch") != std::string::npos, files_of(name, false), files_of(name, own)});
    for (const StimulusFiles& files : {study.images.back().light_field, study.images.back().monitor})
      for (const std::string& file : {files.reference, files.test})
        fs::copy_file(images / fs::path(file).filename(), folder / file, fs::copy_options::skip_existing);
  }
  add_blocks(study, true, 8);
  return parse_study(format_study(study), images.string());  // names that are no ids are told here
}

}  // namespace plenolab
