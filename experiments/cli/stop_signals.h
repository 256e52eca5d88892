#pragma once

namespace plenolab {

/// From now on SIGINT (Ctrl-C), SIGTERM and SIGHUP first remove the files and folders that are not yet in
/// place, then end the process as they always do (a shell sees 130, 143 or 129). Signals that are ignored,
/// e.g. under nohup, stay so. To be called once, before any thread is started.
void clean_up_on_stop_signals();

}  // namespace plenolab
