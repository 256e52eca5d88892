#include "core/luminance/log_average.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/image/repair.h"
#include "core/tonemap/row_math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/luminance/log_average.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PLENOLAB_LOG_AVERAGE_ONCE
#define PLENOLAB_LOG_AVERAGE_ONCE
namespace plenolab {
/// What a kernel is given: the rule as a threshold and a summand.
struct LogSumRule {
  float above, offset;
};
}  // namespace plenolab
#endif

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Sixteen sums run side by side whatever the vector length is: value i always goes to sum i mod 16, so that
// every processor takes the same steps.
constexpr std::size_t kSums = 16;
constexpr std::size_t kBetweenFlushes = 64;  // products of mantissas < 2: below 2^65 here

using Floats = hn::CappedTag<float, kSums>;
using Ints = hn::RebindToSigned<Floats>;
using Vec = hn::Vec<Floats>;
using IntVec = hn::Vec<Ints>;

/// Exponents and mantissas in [1, 2) of positive normal floats.
HWY_INLINE IntVec ExponentOf(Vec v) {
  const Ints di;
  return hn::Sub(hn::ShiftRight<23>(hn::BitCast(di, v)), hn::Set(di, 127));
}
HWY_INLINE Vec MantissaOf(Vec v) {
  const Floats d;
  const Ints di;
  return hn::BitCast(d, hn::Or(hn::And(hn::BitCast(di, v), hn::Set(di, 0x7fffff)), hn::Set(di, 0x3f800000)));
}

/// The sixteen running sums: product·2^exponent, and how many values.
struct Sums {
  HWY_ALIGN float product[kSums];
  HWY_ALIGN std::int32_t exponent[kSums];
  HWY_ALIGN std::int32_t count[kSums];
};

HWY_INLINE void Add(Sums& sums, std::size_t lane, Vec value, const LogSumRule& rule) {
  const Floats d;
  const Ints di;
  const auto counts = hn::Gt(value, hn::Set(d, rule.above));
  const Vec used = hn::IfThenElse(counts, hn::Add(value, hn::Set(d, rule.offset)), hn::Set(d, 1.0f));
  hn::Store(hn::Mul(hn::Load(d, sums.product + lane), MantissaOf(used)), d, sums.product + lane);
  hn::Store(hn::Add(hn::Load(di, sums.exponent + lane), ExponentOf(used)), di, sums.exponent + lane);
  hn::Store(hn::Sub(hn::Load(di, sums.count + lane), hn::VecFromMask(di, hn::RebindMask(di, counts))), di,
            sums.count + lane);
}

/// Moves the exponents of the products to where exponents are added.
HWY_INLINE void Flush(Sums& sums) {
  const Floats d;
  const Ints di;
  for (std::size_t lane = 0; lane < kSums; lane += hn::Lanes(d)) {
    const Vec product = hn::Load(d, sums.product + lane);
    hn::Store(hn::Add(hn::Load(di, sums.exponent + lane), ExponentOf(product)), di, sums.exponent + lane);
    hn::Store(MantissaOf(product), d, sums.product + lane);
  }
}

/// Runs over values that `load(index)` gives for full vectors and `value(index)` for single ones.
template <class Load, class Value>
HWY_INLINE LogSum SumOver(std::size_t length, const LogSumRule& rule, const Load& load, const Value& value) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  Sums sums;
  for (std::size_t i = 0; i < kSums; ++i) sums.product[i] = 1, sums.exponent[i] = 0, sums.count[i] = 0;
  std::size_t i = 0, since_flush = 0;
  for (; i + kSums <= length; i += kSums) {
    for (std::size_t lane = 0; lane < kSums; lane += lanes) Add(sums, lane, load(i + lane), rule);
    if (++since_flush == kBetweenFlushes) Flush(sums), since_flush = 0;
  }
  if (i < length) {
    // −1 is never above the threshold, which is at least −½: it does not count.
    HWY_ALIGN float rest[kSums];
    for (std::size_t k = 0; k < kSums; ++k) rest[k] = i + k < length ? value(i + k) : -1.0f;
    for (std::size_t lane = 0; lane < kSums; lane += lanes) Add(sums, lane, hn::Load(d, rest + lane), rule);
  }
  Flush(sums);
  LogSum result;
  double product = 1, exponent = 0;  // of 16 mantissas below 2: below 2^16
  for (std::size_t k = 0; k < kSums; ++k) {
    product *= static_cast<double>(sums.product[k]);
    exponent += sums.exponent[k];
    result.count += sums.count[k];
  }
  constexpr double kLn2 = 0.69314718055994530942;
  result.ln_sum = std::log(product) + kLn2 * exponent;
  return result;
}

void LogSumOf(const float* values, std::size_t length, const LogSumRule& rule, LogSum& sum) {
  const Floats d;
  sum = SumOver(
      length, rule, [values, d](std::size_t i) { return hn::LoadU(d, values + i); },
      [values](std::size_t i) { return values[i]; });
}

void LogSumOfMixture(const float* const* columns, const float* weights, std::size_t terms, std::size_t length,
                     const LogSumRule& rule, LogSum& sum) {
  const Floats d;
  sum = SumOver(
      length, rule,
      [=](std::size_t i) {
        Vec mixed = hn::Zero(d);
        for (std::size_t k = 0; k < terms; ++k)
          mixed = hn::Add(mixed, hn::Mul(hn::Set(d, weights[k]), hn::LoadU(d, columns[k] + i)));
        return mixed;
      },
      [=](std::size_t i) {
        float mixed = 0;
        for (std::size_t k = 0; k < terms; ++k) mixed = mixed + weights[k] * columns[k][i];
        return mixed;
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {

namespace {
HWY_EXPORT(LogSumOf);
HWY_EXPORT(LogSumOfMixture);

LogSumRule rule_of(const LogAverageOptions& options) {
  if (options.rule == LogAverageOptions::Rule::kOffset) return {-0.5f, static_cast<float>(options.delta)};
  return {static_cast<float>(options.epsilon), 0};
}
}  // namespace

void LogAverageOptions::validate() const {
  const auto require = [](double value, const char* name) {
    if (!(value >= 1e-30 && value <= 1e30))
      throw InputError(
          fmt::format("the {} of the log average must be from 1e-30 to 1e30 cd/m², not {:g}", name, value));
  };
  require(epsilon, "smallest luminance");
  require(delta, "offset");
}

LogSum log_sum(std::span<const float> luminance, const LogAverageOptions& options) {
  LogSum sum;
  HWY_DYNAMIC_DISPATCH(LogSumOf)(luminance.data(), luminance.size(), rule_of(options), sum);
  return sum;
}

LogSum log_sum_of_mixture(std::span<const float* const> columns, std::span<const float> weights,
                          std::size_t length, const LogAverageOptions& options) {
  PLENOLAB_CHECK(columns.size() == weights.size(), "a weight for every column");
  LogSum sum;
  HWY_DYNAMIC_DISPATCH(LogSumOfMixture)
  (columns.data(), weights.data(), columns.size(), length, rule_of(options), sum);
  return sum;
}

std::optional<double> log_average(const SceneImage& image, const LogAverageOptions& options) {
  options.validate();
  SceneImage usable = image;
  repair(usable);
  std::vector<float> row(static_cast<std::size_t>(image.width()));
  LogSum sum;
  for (int y = 0; y < image.height(); ++y) {
    luminance_row({usable.row(y), row.size()}, row);
    sum += log_sum(row, options);
  }
  return sum.ln_average();
}

}  // namespace plenolab
#endif
