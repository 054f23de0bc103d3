// strahl join: collects the bands of all parts in their order.
#include "main/commands/command_join.h"

#include <memory>
#include <set>

#include "files/error.h"
#include "files/output_file.h"
#include "image/band_file.h"
#include "image/picture_writer.h"
#include "main/process/exit_status.h"

namespace strahl {
namespace {

/// Returns numbers in words: "1, 4 and 7 of 16".
std::string in_words(const std::set<int>& parts, int all) {
    std::string words;
    for (auto part = parts.begin(); part != parts.end(); ++part) {
        if (part != parts.begin()) words += std::next(part) == parts.end() ? " and " : ", ";
        words += std::to_string(*part);
    }
    return words + " of " + std::to_string(all);
}

}  // namespace

int join_command(const JoinOptions& options) {
    if (options.output.empty()) throw UsageError("no output file. Add -o FILE");
    std::unique_ptr<PictureWriter> writer;
    BandHeader first;
    for (const std::string& path : options.parts) {
        refuse_overwriting("-o", options.output, "a part", path);
        const auto file = std::make_shared<BandFile>(path);
        BandHeader header = file->header();
        if (!writer) {
            first = header;
            const Layout& layout = header.layout;
            if (options.output != "-" && ending_of(options.output) != header.ending)
                throw UsageError("'" + path + "' is a part of a " + header.ending + " file; give -o that ending");
            writer = std::make_unique<PictureWriter>(layout.width, layout.height, layout.channels, header.ending,
                                                     FileFormat{layout.bits, false, header.compression}, layout.named);
        }
        header.part = first.part;
        if (const std::string key = header.difference(first); !key.empty())
            throw FileError("'" + path + "' and '" + options.parts[0] +
                            "' are not parts of one picture: they differ in the " +
                            (key == "part"   ? "number of parts"
                             : key == "file" ? "kind or size of file"
                                             : key));
        writer->take(file);
    }
    std::set<int> missing;
    for (int band = 0; band < writer->count(); ++band)
        if (!writer->finished(band)) missing.insert(band % first.parts + 1);
    if (!missing.empty())
        throw FileError("the picture is incomplete; parts whose bands are missing: " + in_words(missing, first.parts));
    writer->write(options.output);
    return exit_status::done;
}

}  // namespace strahl
