// strahl render: a scene becomes a picture file, a flythrough a sequence of them.
#pragma once
#include "main/render/render_options.h"

namespace strahl {

/// Returns the exit status: done or interrupted. Throws FileError, UsageError or OutputError.
int render_command(const RenderOptions& options);

}  // namespace strahl
