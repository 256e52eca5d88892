#include "analysis/psychophysics/equivalence.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/psychophysics/binomial.h"
#include "core/base/error.h"

namespace plenolab {

void EquivalenceOptions::validate() const {
  if (!(margin > 0 && low() >= 0 && high() <= 1))
    throw InputError(
        fmt::format("the margin {} around {} must be above 0 and stay within [0, 1]", margin, centre));
  if (!(alpha > 0 && alpha < 1)) throw InputError(fmt::format("alpha is {} but must lie in (0, 1)", alpha));
}

double equivalence_p(Proportion count, const EquivalenceOptions& options) {
  options.validate();
  count.validate();
  return std::max(upper_tail(count.hits, count.trials, options.low()),
                  lower_tail(count.hits, count.trials, options.high()));
}

EquivalenceRegion equivalence_region(std::int64_t trials, const EquivalenceOptions& options) {
  options.validate();
  // The upper test is the lower one, counted in failures.
  return {critical_number(trials, options.low(), options.alpha),
          trials - critical_number(trials, 1 - options.high(), options.alpha)};
}

double equivalence_power(std::int64_t trials, double p, const EquivalenceOptions& options) {
  const EquivalenceRegion region = equivalence_region(trials, options);
  if (region.empty()) return 0;
  const double outside = lower_tail(region.low - 1, trials, p) + upper_tail(region.high + 1, trials, p);
  return std::clamp(1 - outside, 0.0, 1.0);
}

}  // namespace plenolab
