// Channels of .exr files are found by their names, wherever they stand and whatever stands beside them.
#include <doctest/doctest.h>

#include <bit>

#include "image/picture.h"
#include "tests/unit/faults.h"
#include "tests/unit/image/exr_bytes.h"
#include "tests/unit/scratch.h"

namespace strahl {
namespace {

constexpr int whole = 0, half = 1, single = 2;

/// A channel of two floats: the value, and twice the value.
ExrChannel floats(const char* name, float value) {
    return {name, single, {std::bit_cast<std::uint32_t>(value), std::bit_cast<std::uint32_t>(2 * value)}};
}
/// A channel of the half floats 1 and 0.5.
ExrChannel halves(const char* name) { return {name, half, {0x3C00, 0x3800}}; }
ExrChannel numbers(const char* name) { return {name, whole, {7, 4294967295}}; }

Picture reading(const std::vector<ExrChannel>& channels) {
    const Scratch folder;
    std::ofstream(folder / "a.exr", std::ios::binary) << exr_of_channels(channels);
    return read_picture(folder / "a.exr");
}
void reads(const std::vector<ExrChannel>& channels, int count, const std::vector<double>& values) {
    const Picture picture = reading(channels);
    CHECK(picture.width == 2);
    CHECK(picture.channels == count);
    CHECK(picture.values == values);
}
void refuses(const std::vector<ExrChannel>& channels, const char* why) {
    const std::string fault = fault_of([&] { reading(channels); });
    CAPTURE(fault);
    CHECK(says(fault, why));
}

TEST_CASE("colours of .exr files are read beside depth, normals, names and layers") {
    const ExrChannel red = floats("R", 1), green = floats("G", 2), blue = floats("B", 3), alpha = floats("A", .5);
    const std::vector<double> colours{1, 2, 3, 2, 4, 6}, with_alpha{1, 2, 3, .5, 2, 4, 6, 1};
    reads({blue, green, red}, 3, colours);
    reads({blue, green, red, floats("Z", 9)}, 3, colours);
    reads({blue, floats("D", 9), floats("E.R", 8), green, numbers("Id"), red}, 3, colours);
    reads({alpha, blue, green, red, floats("Z", 9)}, 4, with_alpha);
    reads({alpha, blue, green, floats("N.X", 7), floats("N.Y", 8), floats("N.Z", 9), red}, 4, with_alpha);
    reads({floats("AA", 9), blue, green, red, floats("Y", 9)}, 3, colours);
    reads({floats("b", 3), floats("depth", 9), floats("g", 2), floats("r", 1)}, 3, colours);
}

TEST_CASE("grey .exr files have a channel Y") {
    reads({floats("Y", 2)}, 1, {2, 4});
    reads({floats("Y", 2), floats("Z", 9)}, 1, {2, 4});
    reads({floats("A", 1), floats("Y", 2), floats("Z", 9)}, 2, {2, 1, 4, 2});
}

TEST_CASE("half floats and floats may stand side by side; whole numbers are no colours") {
    reads({halves("B"), halves("G"), halves("R")}, 3, {1, 1, 1, .5, .5, .5});
    reads({halves("B"), floats("G", 3), numbers("Id"), halves("R"), floats("Z", 9)}, 3, {1, 3, 1, .5, 6, .5});
    refuses({floats("B", 1), floats("G", 1), numbers("R")}, "its channel R holds whole numbers");
    refuses({numbers("Y")}, "its channel Y holds whole numbers");
}

TEST_CASE("the only layer with colours is read, and of several none") {
    reads({floats("View.All.A", 1), floats("View.All.B", 3), floats("View.All.G", 2), floats("View.All.R", 1),
           floats("View.Depth.Z", 9), floats("View.Normal.X", 9), floats("View.Normal.Y", 9)},
          4, {1, 2, 3, 1, 2, 4, 6, 2});
    reads({floats("B", 3), floats("G", 2), floats("L.B", 9), floats("L.G", 9), floats("L.R", 9), floats("R", 1)}, 3,
          {1, 2, 3, 2, 4, 6});
    refuses(
        {floats("L.B", 9), floats("L.G", 9), floats("L.R", 9), floats("M.B", 9), floats("M.G", 9), floats("M.R", 9)},
        "its colours are in several layers (L., M.); save one of them as a picture of its own");
}

TEST_CASE(".exr files without colours are refused with the names of their channels") {
    refuses({floats("G", 1), floats("R", 1)}, "its channels are R, G; colours need R, G and B, or Y alone");
    refuses({floats("B", 1), floats("L.B", 9), floats("L.G", 9), floats("L.R", 9)}, "colours need R, G and B");
    refuses({floats("Z", 1)}, "its channels are Z");
    refuses({floats("X", 1), floats("Y", 1), floats("Z", 1)}, "colours need R, G and B");
    // OpenImageIO 2.5 reads luminance and chroma, of which this file has too much, and gives its own reason.
    refuses({floats("BY", 1), floats("RY", 1), floats("Y", 1)}, "BY");
}

}  // namespace
}  // namespace strahl
