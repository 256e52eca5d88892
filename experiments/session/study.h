#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plenolab {

/// What a session is for. The mode is stored with every session and exported with every trial, so that trial
/// runs are never taken for data.
enum class SessionMode {
  kReal,       ///< participants whose answers count
  kPilot,      ///< trying the study out
  kSimulated,  ///< simulated participants; never the mode of a study file
};

/// "real", "pilot" or "simulated".
const char* name_of(SessionMode mode);

/// The two kinds of display of the comparison.
enum class DisplayKind { kLightField, kMonitor };

/// "light-field" or "monitor".
const char* name_of(DisplayKind display);

/// Files of one image on one display, relative to the study file.
struct StimulusFiles {
  std::string reference;  ///< PNG of the gold standard (VC); also shown as one of the two comparisons
  std::string test;       ///< PNG of the image under test (IC)
  friend bool operator==(const StimulusFiles&, const StimulusFiles&) = default;
};

/// One image of the study.
struct StudyImage {
  std::string id;
  bool catch_trial = false;            ///< the test image is plainly different: who takes it does not attend
  StimulusFiles light_field, monitor;  ///< equal if the file gives one pair for both
  bool identical = false;              ///< test and reference are meant to be equal, e.g. to look for biases

  const StimulusFiles& on(DisplayKind display) const {
    return display == DisplayKind::kLightField ? light_field : monitor;
  }
  friend bool operator==(const StudyImage&, const StudyImage&) = default;
};

/// Trials in sequence on one display, one for each image, in random order.
struct StudyBlock {
  std::string id;
  DisplayKind display = DisplayKind::kMonitor;
  int screen = 0;  ///< SDL's display index
  int zoom = 1;    ///< every pixel as zoom × zoom pixels (nearest), on black; 1 = pixel for pixel
  std::vector<std::string> images;  ///< ids
  friend bool operator==(const StudyBlock&, const StudyBlock&) = default;
};

/// An order of blocks; participant number n gets order (n − 1) modulo their number.
struct BlockOrder {
  std::string name;
  std::vector<std::string> blocks;  ///< ids
  friend bool operator==(const BlockOrder&, const BlockOrder&) = default;
};

/// A question at the end. Without choices the answer is a text typed on the keyboard; it may be left empty.
struct StudyQuestion {
  std::string id, text;
  std::vector<std::string> choices;
  friend bool operator==(const StudyQuestion&, const StudyQuestion&) = default;
};

/// What participants agree to before anything else.
struct ConsentText {
  std::string text, guardian_text;
  int adult_age = 18;      ///< younger participants need their guardian's consent
  bool signature = false;  ///< whether names are typed; they go into the consent file alone
  friend bool operator==(const ConsentText&, const ConsentText&) = default;
};

/// Which questions about the person are asked. Far-sighted participants are excluded if vision is asked: the
/// scenes are as near as 12 cm. The age can always be refused.
struct Demographics {
  bool age = true, sex = true, vision = true;
  friend bool operator==(const Demographics&, const Demographics&) = default;
};

/// A study as in its file, "plenolab-study" version 1 (experiments/session/README.md explains every key).
struct StudyDefinition {
  std::string title;
  SessionMode mode = SessionMode::kPilot;
  std::uint64_t seed = 1;                 ///< of all random orders
  int blank_ms = 250;                     ///< black between two images, ≥ 250 (section 4.1.2 of the thesis)
  bool return_to_reference = true;        ///< false: the variant of appendix E
  int text_screen = 0;                    ///< SDL's display index for everything that is read
  std::vector<std::string> instructions;  ///< paragraphs shown before the first trial of a session
  ConsentText consent;
  Demographics demographics;
  std::vector<StudyImage> images;
  std::vector<StudyBlock> blocks;
  std::vector<BlockOrder> orders;
  std::vector<StudyQuestion> questionnaire;
  /// Content hash of every image file that is shown, by its name: found by read_study, not in the study file.
  std::map<std::string, std::string> image_hashes;

  const StudyImage& image(const std::string& id) const;  ///< the id must exist
  const StudyBlock& block(const std::string& id) const;  ///< the id must exist
  friend bool operator==(const StudyDefinition&, const StudyDefinition&) = default;
};

/// Parses a study file; `name` stands for it in messages. Throws InputError with one sentence naming file and
/// key for anything missing, unknown, out of range, used twice or referring to what is not there. Ids are 1
/// to 32 letters, digits, '-' or '_'; image files stay in the study's folder.
StudyDefinition parse_study(std::string_view json, const std::string& name);

/// The text of a study file, ending in a newline; parse_study gives the same study back.
std::string format_study(const StudyDefinition& study);

/// Hash of everything in the study but its comments and layout, and of what its images show: two sessions
/// with the same hash ran the same study.
std::string study_hash(const StudyDefinition& study);

/// Whether the consent is still the text that `session new` writes for it to be replaced.
bool is_placeholder(const ConsentText& consent);

}  // namespace plenolab
