#pragma once

#include <functional>

namespace plenolab {

/// Makes sure that no file the program opens takes the place of a standard stream that was closed before the
/// program began (`>&-`): what is printed would go into it. Writing to such a stream fails.
void reserve_standard_streams();

/// Runs `action`, then writes out what standard output still holds back. Throws InputError with the reason if
/// anything printed was lost, e.g. because the disk is full.
void print_whole(const std::function<void()>& action);

}  // namespace plenolab
