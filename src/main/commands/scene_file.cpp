#include "main/commands/scene_file.h"

#include "files/read_file.h"
#include "image/pixels.h"
#include "text/parse.h"

namespace strahl {

Scene load_scene(const std::string& path) { return parse_scene(read_text(path), shown_name(path), {}, read_pixels); }

}  // namespace strahl
