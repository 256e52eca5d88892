#include "analysis/psychophysics/participant_effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kBootstrap = 0x7061727469626f6fu, kPermutation = 0x7061727469706572u;

/// What is used of a trial.
struct Answer {
  std::size_t participant = 0, image = 0;
  bool hit = false;
};

struct Answers {
  std::vector<Answer> answers;  ///< those of one image stand together
  std::size_t participants = 0, images = 0;
};

Answers answers_of(const std::vector<StudyTrial>& trials) {
  Answers all;
  std::map<std::string, std::size_t> participants;
  std::map<std::tuple<std::string, std::string>, std::size_t> images;
  for (const StudyTrial& trial : trials) {
    if (trial.is_catch) continue;
    const auto participant = participants.try_emplace(trial.participant, participants.size()).first;
    const auto image = images.try_emplace({trial.display, trial.image}, images.size()).first;
    all.answers.push_back({participant->second, image->second, trial.chose_test});
  }
  std::stable_sort(all.answers.begin(), all.answers.end(),
                   [](const Answer& a, const Answer& b) { return a.image < b.image; });
  all.participants = participants.size();
  all.images = images.size();
  return all;
}

/// Rate of each image if participant i counts `weights[i]` times; 0 where an image has no trials left.
std::vector<double> rates_of_images(const Answers& all, const std::vector<double>& weights) {
  std::vector<double> hits(all.images), trials(all.images);
  for (const Answer& answer : all.answers) {
    trials[answer.image] += weights[answer.participant];
    hits[answer.image] += answer.hit ? weights[answer.participant] : 0;
  }
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (trials[i] > 0) hits[i] /= trials[i];
  return hits;
}

/// The mean product of two trials of one participant; empty if there are no two with both answers possible.
std::optional<double> correlation(const Answers& all, const std::vector<double>& weights) {
  const std::vector<double> rates = rates_of_images(all, weights);
  std::vector<double> sums(all.participants), squares(all.participants), trials(all.participants);
  for (const Answer& answer : all.answers) {
    const double rate = rates[answer.image], variance = rate * (1 - rate);
    if (!(variance > 0)) continue;
    const double z = ((answer.hit ? 1 : 0) - rate) / std::sqrt(variance);
    sums[answer.participant] += z;
    squares[answer.participant] += z * z;
    trials[answer.participant] += 1;
  }
  double products = 0, pairs = 0;
  for (std::size_t i = 0; i < all.participants; ++i) {
    products += weights[i] * (sums[i] * sums[i] - squares[i]);
    pairs += weights[i] * trials[i] * (trials[i] - 1);
  }
  return pairs > 0 ? std::optional(products / pairs) : std::nullopt;
}

std::size_t index_below(RandomStream& random, std::size_t end) {
  return std::min(end - 1, static_cast<std::size_t>(random.next_double() * static_cast<double>(end)));
}

/// Deals the answers of each image out anew among its trials (Fisher & Yates).
void permute(Answers& all, RandomStream& random) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < all.answers.size(); ++i) {
    if (all.answers[i].image != all.answers[first].image) first = i;
    const std::size_t other = first + index_below(random, i - first + 1);
    std::swap(all.answers[i].hit, all.answers[other].hit);
  }
}

double permutation_p(Answers all, double observed, const ParticipantEffectOptions& options) {
  const std::vector<double> once(all.participants, 1.0);
  int as_large = 1;
  for (int r = 0; r < options.resamples; ++r) {
    RandomStream random(options.seed, kPermutation, static_cast<std::uint64_t>(r));
    permute(all, random);
    // The same counts summed in another order may differ in the last digits.
    as_large += correlation(all, once).value_or(0) >= observed - 1e-9 ? 1 : 0;
  }
  return as_large / (options.resamples + 1.0);
}

Interval bootstrap(const Answers& all, double observed, const ParticipantEffectOptions& options) {
  std::vector<double> values;
  for (int r = 0; r < options.resamples; ++r) {
    RandomStream random(options.seed, kBootstrap, static_cast<std::uint64_t>(r));
    std::vector<double> weights(all.participants);
    for (std::size_t i = 0; i < all.participants; ++i) weights[index_below(random, all.participants)] += 1;
    if (const auto value = correlation(all, weights)) values.push_back(*value);
  }
  if (values.empty()) return {observed, -1, 1};
  const double tail = (1 - options.confidence) / 2;
  return {observed, std::min(observed, quantile(values, tail)),
          std::max(observed, quantile(values, 1 - tail))};
}

}  // namespace

void ParticipantEffectOptions::validate() const {
  if (!(confidence > 0 && confidence < 1))
    throw InputError(fmt::format("confidence is {} but must lie in (0, 1)", confidence));
  if (resamples < 100)
    throw InputError(fmt::format("the number of resamples is {} but must be at least 100", resamples));
}

std::optional<ParticipantEffect> participant_effect(const std::vector<StudyTrial>& trials,
                                                    const ParticipantEffectOptions& options) {
  options.validate();
  const Answers all = answers_of(trials);
  if (all.participants < 2) return std::nullopt;
  const auto observed = correlation(all, std::vector<double>(all.participants, 1.0));
  if (!observed) return std::nullopt;
  return ParticipantEffect{bootstrap(all, *observed, options), permutation_p(all, *observed, options)};
}

}  // namespace plenolab
