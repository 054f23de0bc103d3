#include "image/picture_writer.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <map>
#include <type_traits>

#include "files/output_file.h"
#include "image/transfer.h"

namespace strahl {
namespace {

/// Converts `count` values to the codes of the file, by the table where there is one. Alpha is never light.
template <class T>
void store(const T* values, std::size_t count, const Layout& layout, double gamma,
           const std::optional<TransferTable>& table, std::byte* codes) {
    const int bits = layout.bits;
    const auto convert = [&](auto* to, const auto& code_of) {
        using Code = std::remove_pointer_t<decltype(to)>;
        for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<Code>(code_of(values[i]));
    };
    const auto bytes = reinterpret_cast<std::uint8_t*>(codes);
    const auto words = reinterpret_cast<std::uint16_t*>(codes);
    if (bits == 32)
        std::copy_n(values, count, reinterpret_cast<float*>(codes));
    else if (table)
        convert(bytes, *table);
    else if (bits == 8)
        convert(bytes, [](double v) { return quantise(v, 0, 255); });
    else if (gamma != 0)
        convert(words, [gamma](double v) { return quantise(v, gamma, 65535); });
    else
        convert(words, [](double v) { return quantise(v, 0, 65535); });
    if (layout.channels != 4 || bits == 32) return;
    for (std::size_t i = 3; i < count; i += 4)
        if (const std::uint16_t alpha = quantise(values[i], 0, bits == 8 ? 255 : 65535); bits == 8)
            bytes[i] = static_cast<std::uint8_t>(alpha);
        else
            words[i] = alpha;
}

Layout layout_of(int width, int height, int channels, const std::string& named, int bits, const ChannelNames& names) {
    if (const std::string fault = format_fault(named, bits); !fault.empty()) throw OutputError(fault);
    const std::string ending = ending_of(named);
    assert(channels >= 1 && (channels <= 4 || static_cast<int>(names.names.size()) == channels));
    if (ending == ".bmp" && channels != 3)
        throw OutputError("cannot write '" + named + "': a .bmp file holds red, green and blue; choose .png or .exr");
    return {width, height, channels, bits_of(ending, bits), names};
}

}  // namespace

PictureWriter::PictureWriter(int width, int height, int channels, const std::string& named, FileFormat own_format,
                             const ChannelNames& names)
    : format(own_format),
      encoder(encoder_for(ending_of(named), layout_of(width, height, channels, named, own_format.bits, names),
                          own_format.compression)) {
    if ((format.gamma != 0 || format.exposure) && layout().bits == 8) table.emplace(format.gamma, format.exposure);
    for (int i = 0; i < encoder->bands(); ++i) {
        bands.push_back(std::make_unique<Band>());
        bands.back()->missing = std::size_t(width) * unsigned(encoder->rows(i));
    }
}
PictureWriter::~PictureWriter() = default;

void PictureWriter::put(int x, int y, int columns, int rows, const double* values) {
    put_any(x, y, columns, rows, values);
}
void PictureWriter::put(int x, int y, int columns, int rows, const float* values) {
    put_any(x, y, columns, rows, values);
}

std::byte* PictureWriter::codes_of(Band& band, int rows) {
    const std::lock_guard lock(mutex);
    if (band.codes.empty()) band.codes.resize(encoder->layout.row_bytes() * unsigned(rows));
    return band.codes.data();
}

template <class T>
void PictureWriter::put_any(int x, int y, int columns, int rows, const T* values) {
    const Layout& layout = encoder->layout;
    const auto count = std::size_t(columns) * unsigned(layout.channels);
    for (int done = 0; done < rows;) {
        // The rows that go to one band, in the order of the picture.
        const auto place = [&](int row) { return encoder->bottom_up() ? layout.height - 1 - y - row : y + row; };
        const int i = place(done) / band_rows;
        Band& band = *bands[unsigned(i)];
        std::byte* const codes = codes_of(band, encoder->rows(i));
        const int first = done;
        for (; done < rows && place(done) / band_rows == i; ++done) {
            const std::size_t row = unsigned(place(done) % band_rows);
            const std::size_t pixel = row * unsigned(layout.width) + unsigned(x);
            std::byte* const to = codes + pixel * unsigned(layout.channels * layout.bits / 8);
            store(values + unsigned(done) * count, count, layout, format.gamma, table, to);
        }
        const auto pixels = std::size_t(columns) * unsigned(done - first);
        if (band.missing.fetch_sub(pixels) == pixels) encode(band, encoder->rows(i));
    }
}

void PictureWriter::encode(Band& band, int rows) {
    band.encoded = encoder->encode(codes_of(band, rows), rows);
    std::vector<std::byte>().swap(band.codes);
    bytes_held += band.encoded.bytes.size();
    band.ready = true;
}

std::pair<int, int> PictureWriter::rows(int band) const {
    const int first = band * band_rows, last = first + encoder->rows(band), height = layout().height;
    return encoder->bottom_up() ? std::pair(height - last, height - first) : std::pair(first, last);
}

void PictureWriter::take(std::shared_ptr<BandFile> file) {
    for (int i = 0; i < count(); ++i)
        if (Band& band = *bands[unsigned(i)]; file->has(i) && !band.ready) band.in = file, band.ready = true;
}

void PictureWriter::save(const std::shared_ptr<BandFile>& file) {
    for (int i = 0; i < count(); ++i) {
        Band& band = *bands[unsigned(i)];
        if (!band.ready || band.in) continue;
        file->append(i, band.encoded);
        band.in = file;
        bytes_held -= band.encoded.bytes.size();
        std::string().swap(band.encoded.bytes);  // an assignment would keep the memory
    }
    file->sync();
}

void PictureWriter::write(const std::string& path) {
    OutputFile file(path);
    write([&](std::string_view bytes) { file.append(bytes); });
    file.finish();
}

void PictureWriter::write(const Encoder::Append& append) {
    std::map<int, Band> black;  // by their rows
    const auto at = [&](int i) -> Band& {
        Band& band = *bands[unsigned(i)];
        if (!band.ready && !band.codes.empty()) encode(band, encoder->rows(i));
        if (band.ready) return band;
        Band& same = black[encoder->rows(i)];
        if (!same.ready) encode(same, encoder->rows(i));
        return same;
    };
    std::vector<std::string> notes;
    for (int i = 0; i < count(); ++i) notes.push_back(at(i).in ? at(i).in->note(i) : at(i).encoded.note);
    encoder->assemble(
        notes, [&](int i) { return at(i).in ? at(i).in->bytes(i) : at(i).encoded.bytes; }, append);
}

}  // namespace strahl
