#include "experiments/session/example_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/content_hash.h"
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

/// Two blocks with all images and both orders. The central subimage is small, so the monitor magnifies it;
/// whole images are shown as they are.
void add_blocks(StudyDefinition& study) {
  std::vector<std::string> ids;
  int zoom = 8;
  for (const StudyImage& image : study.images)
    if (image.monitor == image.light_field) zoom = 1;
  for (const StudyImage& image : study.images) ids.push_back(image.id);
  study.blocks = {{"headset", DisplayKind::kLightField, 0, 1, ids},
                  {"monitor", DisplayKind::kMonitor, 0, zoom, ids}};
  study.orders = {{"headset-first", {"headset", "monitor"}}, {"monitor-first", {"monitor", "headset"}}};
}

/// How the files of an image set end behind the name of an image.
struct PairNames {
  std::string_view reference, test, monitor_reference, monitor_test;
};
constexpr PairNames kReprojected{"-vc-panel.png", "-ic-panel.png", "-vc-centre.png", "-ic-centre.png"};
constexpr PairNames kPairs{"-reference.png", "-test.png", "-monitor-reference.png", "-monitor-test.png"};

/// Images of a folder whose files end like that, sorted by name; without files of its own the monitor shows
/// those of the light-field display.
std::vector<StudyImage> images_named(const fs::path& folder, const PairNames& names) {
  std::vector<StudyImage> found;
  const auto path = [](const std::string& name, std::string_view end) {
    return fmt::format("images/{}{}", name, end);
  };
  const auto exists = [&](const std::string& file) { return fs::exists(folder / fs::path(file).filename()); };
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(names.reference) || file.ends_with(names.monitor_reference)) continue;
    const std::string name = file.substr(0, file.size() - names.reference.size());
    const StimulusFiles panel{path(name, names.reference), path(name, names.test)};
    const StimulusFiles monitor{path(name, names.monitor_reference), path(name, names.monitor_test)};
    if (!exists(panel.test)) continue;
    const bool own = exists(monitor.reference) && exists(monitor.test);
    found.push_back({name, name.find("catch") != std::string::npos, panel, own ? monitor : panel});
  }
  std::sort(found.begin(), found.end(), [](const StudyImage& a, const StudyImage& b) { return a.id < b.id; });
  return found;
}

/// Throws InputError before a study is written that would be refused.
void require_different(const StudyDefinition& study, const fs::path& images) {
  for (const StudyImage& image : study.images)
    for (const StimulusFiles& files : {image.light_field, image.monitor}) {
      const fs::path reference = images / fs::path(files.reference).filename(),
                     test = images / fs::path(files.test).filename();
      if (hash_file(reference) == hash_file(test))
        throw InputError(
            fmt::format("{} and {} have the same content: a test image must differ from its reference",
                        reference.string(), test.string()));
    }
}

/// Another image altogether is plainly different.
void add_catch_trial(StudyDefinition& study) {
  const auto is_catch = [](const StudyImage& image) { return image.catch_trial; };
  if (study.images.size() < 2 || std::any_of(study.images.begin(), study.images.end(), is_catch)) return;
  const StudyImage one = study.images[0], other = study.images[1];
  study.images.push_back({"catch",
                          true,
                          {one.light_field.reference, other.light_field.reference},
                          {one.monitor.reference, other.monitor.reference}});
}

}  // namespace

StudyDefinition example_study() {
  StudyDefinition study = frame_of_study();
  for (const ExampleImage& image : kImages)
    study.images.push_back(
        {image.id, image.catch_trial, files_of(image.id, false), files_of(image.id, true)});
  add_blocks(study);
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
  if (!fs::is_directory(images)) throw InputError(fmt::format("{} is no folder of images", images.string()));
  StudyDefinition study = frame_of_study();
  for (const PairNames& names : {kReprojected, kPairs})
    if (study.images.empty()) study.images = images_named(images, names);
  if (study.images.empty())
    throw InputError(fmt::format(
        "{} holds neither pairs NAME-vc-panel.png and NAME-ic-panel.png nor pairs NAME-reference.png and "
        "NAME-test.png",
        images.string()));
  add_catch_trial(study);
  require_different(study, images);
  fs::create_directories(folder / "images");
  for (const StudyImage& image : study.images)
    for (const StimulusFiles& files : {image.light_field, image.monitor})
      for (const std::string& file : {files.reference, files.test})
        fs::copy_file(images / fs::path(file).filename(), folder / file, fs::copy_options::skip_existing);
  add_blocks(study);
  return parse_study(format_study(study), images.string());  // names that are no ids are told here
}

}  // namespace plenolab
