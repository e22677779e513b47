#pragma once

namespace radiosity {

/// From now on SIGINT (Ctrl-C) and SIGTERM do not end the process: they are remembered, so that work can end
/// in order and remove what it has half written. SIGPIPE is left alone.
void watch_for_interruption();

/// The signal received since then; 0: none.
int received_signal();

}  // namespace radiosity
