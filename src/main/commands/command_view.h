// strahl view and strahl play: the window.
#pragma once
#include <atomic>

#include "show/session/view_options.h"

namespace strahl {

/// Does this program have a window, and does the environment name a display for it?
bool window_possible();

/// Shows the scene, or the gallery if none is named. Returns the exit status: 1 if a still could not be written. A
/// scene with an error, or none yet, is waited for in the window. Once `interrupted` becomes true the window closes as
/// if by Esc: when the stills are done. Throws UsageError for options that do not suit the scene, FileError for an
/// error in a scene that cannot be mended, and if no window can be opened FileError for the scene, or
/// std::runtime_error with advice.
int view_command(const ViewOptions& options, const std::atomic<bool>* interrupted);

}  // namespace strahl
