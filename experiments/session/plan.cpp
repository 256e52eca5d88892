#include "experiments/session/plan.h"

#include <utility>

#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kImageOrder = 0x736573732d6f7264ull;  // purposes of the study's seed
constexpr std::uint64_t kTestSide = 0x736573732d736964ull;

/// Stream of one block of one participant.
std::uint64_t index_of(int number, std::size_t block) {
  return static_cast<std::uint64_t>(number) << 16 | static_cast<std::uint64_t>(block);
}

/// Uniform in [0, count): rejects the words beyond the last whole multiple, so that no value is favoured.
std::size_t uniform_below(RandomStream& random, std::size_t count) {
  const std::uint64_t limit = ~std::uint64_t{0} - ~std::uint64_t{0} % count;
  std::uint64_t word = random.next_u64();
  while (word >= limit) word = random.next_u64();
  return static_cast<std::size_t>(word % count);
}

}  // namespace

SessionPlan plan_session(const StudyDefinition& study, int number) {
  PLENOLAB_CHECK(number >= 1, std::to_string(number));
  const BlockOrder& order = study.orders[static_cast<std::size_t>(number - 1) % study.orders.size()];
  SessionPlan plan{order.name, {}};
  for (const std::string& id : order.blocks) {
    const StudyBlock& block = study.block(id);
    // Where a block stands in the file, not in the session, chooses its stream.
    const auto place = static_cast<std::size_t>(&block - study.blocks.data());
    RandomStream shuffle(study.seed, kImageOrder, index_of(number, place));
    RandomStream side(study.seed, kTestSide, index_of(number, place));
    std::vector<std::string> images = block.images;
    for (std::size_t left = images.size(); left > 1; --left)
      std::swap(images[left - 1], images[uniform_below(shuffle, left)]);
    PlannedBlock planned{id, {}};
    for (const std::string& image : images)
      planned.trials.push_back({image, study.image(image).catch_trial, (side.next_u64() >> 63) != 0});
    plan.blocks.push_back(planned);
  }
  return plan;
}

}  // namespace plenolab
