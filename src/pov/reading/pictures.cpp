#include "pov/reading/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "files/error.h"
#include "num/turn_rows.h"
#include "pov/reading/values.h"
#include "pov/things/pictures.h"

namespace strahl::pov {
namespace {

const std::vector<std::string> picture_endings{".png", ".PNG", ".jpg", ".JPG", ".jpeg", ".gif", ".GIF", ".tga",
                                               ".TGA", ".bmp", ".BMP", ".tif", ".exr",  ".hdr", ".ppm", ".pgm"};

constexpr std::array picture_words{word("gif"), word("tga"), word("iff"),  word("pot"),       word("png"),
                                   word("pgm"), word("ppm"), word("jpeg"), word("tiff"),      word("sys"),
                                   word("bmp"), word("exr"), word("hdr"),  word("use_color"), word("use_index")};

/// Makes a picture of a function's values from 0 to 1 in x and, downwards, y. As in POV-Ray they are of 16 bits.
std::shared_ptr<const FilePixels> picture_of(Interpreter& in, const FunctionThing& function,
                                             const std::array<int, 2>& size) {
    constexpr int most = 4096;
    if (std::min(size[0], size[1]) < 1 || std::max(size[0], size[1]) > most)
        in.fail("the sides of a picture have 1 to " + std::to_string(most) + " pixels");
    in.count_bytes(4 * sizeof(float) * std::size_t(size[0]) * std::size_t(size[1]), in.last_place());
    auto made = std::make_shared<FilePixels>(Pixels{size[0], size[1], true, {}});
    const auto put = [](std::vector<float>& values, double value) {
        const double code = std::clamp(65535 * value, -1e9, 1e9);  // beyond 0 to 1 it repeats
        values.push_back(static_cast<float>(std::isnan(code) ? 0 : static_cast<long>(code) & 0xffff) / 65535);
    };
    for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i) {
            const double given[3]{i / (size[0] - 1.), j / (size[1] - 1.), 0};
            double result[5]{};
            function.evaluate(given, result);
            for (int c = 0; c < 3; ++c) put(made->values, result[function.results == 1 ? 0 : c]);
            if (function.results == 5) put(made->opacity, 1 - result[4]);
        }
    made->largest = Color(1);
    return made;
}

/// Is a picture of a kind of file whose values POV-Ray takes as they are, unless a gamma is given? Its kind is said by
/// a word, or else by its ending.
bool is_plain(const ImageThing& image) {
    constexpr std::array kinds{word("ppm"), word("pgm"), word("tiff")};
    if (image.file_kind != end_code) return is_one_of(image.file_kind, kinds);
    std::string ending = image.path.substr(image.path.rfind('.') + 1);
    std::ranges::transform(ending, ending.begin(), [](char c) { return 'A' <= c && c <= 'Z' ? char(c + 32) : c; });
    return ending == "ppm" || ending == "pgm" || ending == "tif" || ending == "tiff";
}

}  // namespace

/// Reads the pixels of a picture's file, and says how their values become those of the scene: for colours, as POV-Ray
/// decodes files by what is known of the scene at this place; for heights and the like, by a given gamma alone.
void PictureReader::load(Interpreter& in, ImageThing& image, bool of_colors, bool srgb, std::optional<double> gamma) {
    LoadedPicture& known = files[image.path];
    if (!known.pixels && known.fault.empty() && !image.path.empty() && read_pixels) {
        try {
            FilePixels own = read_pixels(image.path);
            if (own.from_right) {  // POV-Ray takes them in the order of the file
                turn_rows(own.values, std::size_t(own.width), 3);
                turn_rows(own.opacity, std::size_t(own.width), 1);
                if (in.options.as_text)
                    in.remark(Remark::Kind::approximated, in.last_place(), "a picture is seen from its other side");
            }
            known.pixels = std::make_shared<const FilePixels>(std::move(own));
        } catch (const FileError& error) {
            known.fault = error.what();
        }
    }
    image.pixels = known.pixels, image.fault = known.fault, image.facts = known.facts;
    if (!image.pixels) return;
    image.encoding = gamma;
    if (of_colors && in.assumed_gamma) image.working = srgb ? 0 : *in.assumed_gamma;
    const bool decodes = in.version_given() && in.version() >= 3.7;
    if (of_colors && !gamma && !is_plain(image) && (decodes || in.assumed_gamma)) {
        if (image.pixels->gamma)
            image.encoding = image.pixels->gamma;
        else if (image.pixels->linear)
            image.encoding = 1;
        else if (decodes)
            image.encoding = 0;
    }
    if (!image.pixels->grey_png) return;
    LoadedPicture& grey = grey_files[{image.path, image.encoding.value_or(-1), image.working}];
    if (!grey.pixels) grey.pixels = grey_values_of(image);
    image.pixels = grey.pixels, image.facts = grey.facts, image.encoding = std::nullopt;
}

std::shared_ptr<const ImageThing> PictureReader::read(Interpreter& in, bool of_colors, bool srgb) {
    auto image = std::make_shared<ImageThing>();
    std::optional<double> gamma;
    bool premultiplied = false;
    in.begin_block();
    if (in.at("function")) {
        std::array<int, 2> size{};
        const auto function = in.read_function(&size);
        image->pixels = picture_of(in, *function, size);
    }
    std::vector<std::string> endings = picture_endings;
    while (!in.at('}')) {
        if (in.at_string()) {
            image->path = in.find_file(in.read_file_name(), endings);
            continue;
        }
        const std::uint16_t code = in.code();
        if (in.at_expression() && code < first_word_code) {  // an old orientation
            in.read_components();
            in.skip_comma();
            continue;
        }
        in.take();
        switch (code) {
            case word("map_type"):
                image->map_type = in.read_integer();
                break;
            case word("interpolate"):
                image->interpolate = in.read_integer();
                break;
            case word("once"):
                image->once = true;
                break;
            case word("filter"):
            case word("transmit"): {
                std::optional<double>& all = code == word("filter") ? image->filter_all : image->transmit_all;
                if (in.accept("all")) {
                    all = in.read_number();
                    break;
                }
                in.read_number(), in.skip_comma(), in.read_number();
                image->single_colors = true;
                break;
            }
            case word("gamma"):
                gamma = in.accept("srgb") ? 0 : in.read_number();
                break;
            case word("repeat"):
                image->repeat = in.read_uv();
                break;
            case word("offset"):
                image->offset = in.read_uv();
                break;
            case word("use_alpha"):
                image->use_alpha = true;
                break;
            case word("premultiplied"):
                premultiplied = in.read_flag();
                break;
            case word("bump_size"):
                image->bump_size = in.read_number();
                break;
            case word("pigment"):
            case word("texture"):
                in.skip_block();
                break;
            default:
                if (!is_one_of(code, picture_words)) in.misplaced();
                if (code != word("use_color") && code != word("use_index") && code != word("sys"))
                    image->file_kind = code;
        }
        in.skip_comma();
    }
    in.end_block();
    if (!image->pixels) load(in, *image, of_colors, srgb, gamma);
    if (premultiplied && image->pixels && !image->pixels->opacity.empty())
        in.remark(Remark::Kind::approximated, in.last_place(), "the colours of a picture are not premultiplied");
    return image;
}

}  // namespace strahl::pov
