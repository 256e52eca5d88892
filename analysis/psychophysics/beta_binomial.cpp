#include "analysis/psychophysics/beta_binomial.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr double kEdge = 1e-9;  ///< rates and ρ are searched this far from 0 and 1
constexpr int kGrid = 24;       ///< places from which the best ρ is searched on
constexpr int kDigits = 40;     ///< bits of Brent's method

struct Maximum {
  double at = 0, value = 0;
};

/// The largest value in [low, high]; unimodal functions only.
Maximum maximise(const std::function<double(double)>& function, double low, double high) {
  const auto [at, negative] =
      boost::math::tools::brent_find_minima([&](double x) { return -function(x); }, low, high, kDigits);
  return {at, -negative};
}

/// The same for functions with several maxima: the best of a grid is refined.
Maximum maximise_from_grid(const std::function<double(double)>& function, double low, double high) {
  const auto place = [&](int i) { return low + (high - low) * i / kGrid; };
  Maximum best{low, function(low)};
  int best_index = 0;
  for (int i = 1; i <= kGrid; ++i)
    if (const double value = function(place(i)); value > best.value) best = {place(i), value}, best_index = i;
  const Maximum refined =
      maximise(function, place(std::max(0, best_index - 1)), place(std::min(kGrid, best_index + 1)));
  return refined.value > best.value ? refined : best;
}

/// Where the function falls to `limit` between `inside`, above it, and `end`; `end` if it does not.
double falls_to(const std::function<double(double)>& function, double limit, double inside, double end) {
  if (function(end) >= limit) return end;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + end);
    (function(middle) >= limit ? inside : end) = middle;
  }
  return 0.5 * (inside + end);
}

class Likelihood {
 public:
  explicit Likelihood(std::span<const Proportion> participants) : participants_(participants) {}
  double operator()(double rate, double rho) const {
    return beta_binomial_log_likelihood(participants_, rate, rho);
  }
  /// Largest over the other parameter.
  double at_rate(double rate) const {
    return maximise_from_grid([&](double rho) { return (*this)(rate, rho); }, 0, 1 - kEdge).value;
  }
  Maximum at_rho(double rho) const {
    return maximise([&](double rate) { return (*this)(rate, rho); }, kEdge, 1 - kEdge);
  }

 private:
  std::span<const Proportion> participants_;
};

Proportion pooled(std::span<const Proportion> participants) {
  Proportion sum;
  for (const Proportion& p : participants) {
    p.validate();
    sum.hits += p.hits;
    sum.trials += p.trials;
  }
  return sum;
}

bool has_repeats(std::span<const Proportion> participants) {
  return std::any_of(participants.begin(), participants.end(),
                     [](const Proportion& p) { return p.trials > 1; });
}

/// Σn² (the pairs of trials of one participant) inflate the variance by 1 + ρ(Σn²/Σn − 1).
double design_effect(std::span<const Proportion> participants, double trials, double rho) {
  double squares = 0;
  for (const Proportion& p : participants)
    squares += static_cast<double>(p.trials) * static_cast<double>(p.trials);
  return 1 + rho * (squares / trials - 1);
}

}  // namespace

double beta_binomial_log_likelihood(std::span<const Proportion> participants, double rate, double rho) {
  // Products of successive chances, as in Pólya's urn: exact down to ρ = 0.
  const auto rising = [&](double share, std::int64_t count) {
    double sum = 0;
    for (std::int64_t j = 0; j < count; ++j)
      sum += std::log(share * (1 - rho) + static_cast<double>(j) * rho);
    return sum;
  };
  double sum = 0;
  for (const Proportion& p : participants)
    sum += rising(rate, p.hits) + rising(1 - rate, p.trials - p.hits) - rising(1, p.trials);
  return sum;
}

BetaBinomialFit fit_beta_binomial(std::span<const Proportion> participants, double confidence) {
  if (participants.empty()) throw InputError("overdispersion needs at least one participant");
  const Proportion all = pooled(participants);
  const Likelihood likelihood(participants);
  BetaBinomialFit fit;
  fit.identified = has_repeats(participants) && all.hits > 0 && all.hits < all.trials;
  if (!fit.identified) {
    fit.rate = clopper_pearson(all, confidence);
    fit.overdispersion = {0, 0, 1};
    return fit;
  }
  const auto profile = [&](double rho) { return likelihood.at_rho(rho).value; };
  const Maximum best = maximise_from_grid(profile, 0, 1 - kEdge);
  fit.overdispersion.estimate = best.at;
  fit.log_likelihood = best.value;
  fit.binomial_log_likelihood = profile(0);
  fit.rate.estimate = likelihood.at_rho(best.at).at;
  const boost::math::chi_squared chi(1);
  const double limit = best.value - 0.5 * quantile(chi, confidence);
  fit.overdispersion.low = falls_to(profile, limit, best.at, 0);
  fit.overdispersion.high = falls_to(profile, limit, best.at, 1 - kEdge);
  const auto profile_rate = [&](double rate) { return likelihood.at_rate(rate); };
  fit.rate.low = falls_to(profile_rate, limit, fit.rate.estimate, kEdge);
  fit.rate.high = falls_to(profile_rate, limit, fit.rate.estimate, 1 - kEdge);
  const double ratio = std::max(0.0, 2 * (best.value - fit.binomial_log_likelihood));
  fit.p_overdispersed = ratio > 0 ? 0.5 * cdf(complement(chi, ratio)) : 1;
  fit.design_effect = design_effect(participants, static_cast<double>(all.trials), best.at);
  return fit;
}

double beta_binomial_posterior_above(std::span<const Proportion> participants, double p) {
  if (participants.empty()) throw InputError("a posterior needs at least one participant");
  pooled(participants);
  constexpr int kRates = 200, kRhos = 60;
  std::vector<double> logs;
  for (int r = 0; r < kRhos; ++r)
    for (int i = 0; i < kRates; ++i)
      logs.push_back(beta_binomial_log_likelihood(participants, (i + 0.5) / kRates, (r + 0.5) / kRhos));
  const double largest = *std::max_element(logs.begin(), logs.end());
  double above = 0, sum = 0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    const double weight = std::exp(logs[k] - largest);
    // A cell that p cuts counts by the share of it that lies above.
    const double cell = static_cast<double>(k % kRates);
    above += weight * std::clamp(cell + 1 - p * kRates, 0.0, 1.0);
    sum += weight;
  }
  return above / sum;
}

}  // namespace plenolab
