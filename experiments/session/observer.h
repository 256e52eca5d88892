#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "experiments/session/stage.h"

namespace plenolab {

/// Simulated participants: what they see is pictures, what they do is press.
enum class ObserverKind {
  kIdeal,           ///< wrong with the given probability of each image, always right where none is given
  kGuessing,        ///< wrong with probability 1/2 on every image, catch trials too
  kLapsing,         ///< ideal, but guesses in a share `rate` of the trials
  kPositionBiased,  ///< ideal, but takes the left image in a share `rate` of the trials
  kImpatient,   ///< ideal, but presses too early, too often and the wrong buttons in a share `rate` of the
                ///< trials
  kUnplugging,  ///< ideal, but the plug comes out in a share `rate` of the trials, with the bumpers held
};

/// Names as on the command line: "ideal", "guessing", "lapsing", "position-biased", "impatient",
/// "unplugging".
const std::vector<std::string>& observer_names();
/// The name must be one of observer_names().
ObserverKind observer_named(const std::string& name);
/// 0.1 for lapsing, 0.8 for position-biased, 0.5 for impatient and unplugging; 0 where it means nothing.
double default_rate(ObserverKind kind);

/// Probability of being wrong by "block/image" or, for all blocks, "image".
using WrongProbabilities = std::map<std::string, double>;

/// Reads a CSV file with the columns block, image, wrong (block may be empty: all blocks). Throws InputError.
WrongProbabilities read_wrong_probabilities(const std::filesystem::path& file);

struct ObserverOptions {
  ObserverKind kind = ObserverKind::kIdeal;
  double rate = 0;
  WrongProbabilities wrong;
  std::uint64_t seed = 1;
  int number = 1;  ///< of the participant
};

/// Something an observer does with the pad at a time.
struct PadAction {
  enum class Kind { kButton, kTrigger, kType, kPlug, kUnplug };
  std::int64_t t_us = 0;
  Kind kind = Kind::kButton;
  std::string name;
  bool down = false;
};

/// One simulated participant. What it does in a trial depends on (seed, number, block, image) and on what it
/// sees alone, so that a trial repeated after an interruption goes as it would have gone.
class Observer {
 public:
  explicit Observer(ObserverOptions options);

  /// This picture is on the display since `t_us`.
  void sees(const Picture& picture, std::int64_t t_us);
  /// What it does next, if that is before `until_us`; each action is handed out once, in order of time.
  std::optional<PadAction> next(std::int64_t until_us);

 private:
  void see_page(const Picture& picture, std::int64_t t_us);
  void see_black(const Picture& picture, std::int64_t t_us);
  void see_image(const Picture& picture, std::int64_t t_us);
  void begin_trial(const Picture& picture);
  void misbehave(const Picture& picture, std::int64_t t_us);
  double wrong_probability(const Picture& picture) const;
  void act(std::int64_t t_us);
  void press(Stimulus stimulus, std::int64_t t_us);
  void tap(const std::string& button, std::int64_t t_us);
  void push(const std::string& trigger, std::int64_t t_us);
  void choose(std::int64_t t_us);
  void pull_plug(std::int64_t t_us);
  void add(PadAction action);
  std::int64_t dwell_us();
  double uniform(const std::string& what) const;

  ObserverOptions options_;
  std::deque<PadAction> actions_;
  RandomStream random_;
  std::string trial_;            // block/image it is in; empty outside
  std::vector<Stimulus> looks_;  // what it wants to see, in order
  std::size_t step_ = 0;
  std::optional<bool> wrong_;  // decided when both comparisons were seen
  bool test_is_left_ = false, misbehaves_ = false, takes_left_ = false;
  std::string page_;            // id of the question it has answered last
  Picture present_;             // what it sees now
  std::int64_t retry_us_ = -1;  // does it again if nothing has changed by then; −1: waits for nothing
};

}  // namespace plenolab
