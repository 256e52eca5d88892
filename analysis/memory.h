#pragma once

#include <functional>
#include <optional>

namespace plenolab {

/// Largest resident set of the process since its start in MiB; absent if unknown.
std::optional<double> peak_resident_mib();

/// Peak resident memory while `work` runs, above what is resident before it, in MiB; absent where the system
/// cannot tell. Measured, not computed: scratch space, thread stacks and what the allocator rounds up are in
/// it. Memory that was freed earlier is first given back to the system, so that work which takes it again is
/// charged for it. What runs beside `work` in the same process counts, too. Linux keeps resident sets to
/// about a quarter of a MiB per core: differences below that mean nothing.
std::optional<double> peak_memory_mib(const std::function<void()>& work);

}  // namespace plenolab
