// strahl compare: reports how much two pictures differ, and where.
#include "main/commands/command_compare.h"

#include <cstdio>

#include "files/output_file.h"
#include "files/utf8.h"
#include "image/compare.h"

namespace strahl {
namespace {

Picture read_and_describe(const std::string& path, std::FILE* out) {
    Picture picture = read_picture(path);
    std::fprintf(out, "%s: %dx%d, %d channel%s, %d bits\n", show(path).text.c_str(), picture.width, picture.height,
                 picture.channels, picture.channels == 1 ? "" : "s", picture.bits);
    return picture;
}

}  // namespace

int compare_command(const CompareOptions& options) {
    if (!options.heatmap.empty() && options.heatmap != "-")
        if (const std::string fault = format_fault(options.heatmap, 0); !fault.empty()) throw FileError(fault);
    for (const std::string& picture : {options.a, options.b})
        refuse_overwriting("--heatmap", options.heatmap, "a picture that is compared", picture);
    // If the heat map goes to standard output, the text cannot.
    std::FILE* const out = options.heatmap == "-" ? stderr : stdout;
    const Picture a = read_and_describe(options.a, out), b = read_and_describe(options.b, out);
    const PictureDifference difference = compare(a, b, options.tolerance);
    std::fputs(report(difference, options.tolerance).c_str(), out);
    if (!options.heatmap.empty()) write_picture(heatmap(a, b), options.heatmap, {}, ".png");
    return difference.share_beyond > 0 ? 1 : 0;
}

}  // namespace strahl
