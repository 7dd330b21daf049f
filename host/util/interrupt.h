// Ctrl-C and termination, turned into a flag that the render loop looks at between tiles.
#pragma once

namespace sahl {

/// From now on SIGINT, SIGTERM and SIGHUP set a flag; a second one ends the process at once.
/// SIGPIPE is ignored, so that a closed stdout becomes a write error.
void watchInterrupts();

/// The signal that arrived, or 0.
int interruptSignal();

}  // namespace sahl
