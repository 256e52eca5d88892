#pragma once

#include <string>

#include "core/base/error.h"

namespace plenolab {

/// The message of the InputError that `action` throws; empty if it throws none.
template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace plenolab
