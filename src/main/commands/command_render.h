// strahl render: renders a scene to a picture file, or a flythrough to many or to a film.
#pragma once
#include "main/render/render_options.h"

namespace strahl {

/// Returns the exit status: done or interrupted. Throws FileError, UsageError or OutputError.
int render_command(const RenderOptions& options);

}  // namespace strahl
