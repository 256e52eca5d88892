#pragma once

#include <string>

namespace plenolab {

/// From now on SIGINT (Ctrl-C), SIGTERM and SIGHUP first remove the files and folders that are not yet in
/// place, then end the process as they always do (a shell sees 130, 143 or 129). Signals that are ignored,
/// e.g. under nohup, stay so. To be called once, before any thread is started.
void clean_up_on_stop_signals();

/// What a stop signal says from now on instead of "nothing unfinished was left behind", for commands that
/// keep what they have done: what that is, and how to go on.
void say_on_stop(std::string what_is_kept);

/// While one exists, the first stop signal ends nothing but is told by requested(), so that the owner can
/// come to an end in good order; a second one stops the process at once. One at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool requested() const;
  /// Ends the process by the signal that came, as a shell expects; returns if none did.
  void end_if_requested() const;
};

}  // namespace plenolab
