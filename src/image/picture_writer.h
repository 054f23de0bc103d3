// Writes a picture whose pixels come in any order and from any thread, and encodes bands as soon as they are complete.
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/band_file.h"
#include "image/transfer_table.h"

namespace strahl {

class PictureWriter {
  public:
    /// `named` is the path of the file, or only its ending. Throws OutputError if such a file cannot hold the picture.
    PictureWriter(int width, int height, int channels, const std::string& named, FileFormat format,
                  const ChannelNames& names = {});
    ~PictureWriter();

    /// Takes the values of a rectangle of pixels from (x, y) on, row by row; the thread that completes a band encodes
    /// it. No pixel may come twice.
    void put(int x, int y, int columns, int rows, const double* values);
    void put(int x, int y, int columns, int rows, const float* values);

    /// Uses the bands of the file as finished ones. Several writers may use a file; it is not changed.
    void take(std::shared_ptr<BandFile> file);
    /// Appends the bands finished since the last call to the file, and frees their memory. To be called by one thread
    /// at a time.
    void save(const std::shared_ptr<BandFile>& file);
    /// Bytes of finished bands in memory.
    std::size_t held() const { return bytes_held; }

    const Layout& layout() const { return encoder->layout; }
    int count() const { return encoder->bands(); }
    bool finished(int band) const { return bands[unsigned(band)]->ready; }
    /// The rows of a band in the picture: the first, and the one after the last.
    std::pair<int, int> rows(int band) const;

    /// Writes the file; pixels that did not come are black. Throws OutputError, and FileError for bands that cannot be
    /// read any more.
    void write(const std::string& path);
    void write(const Encoder::Append& append);

  private:
    struct Band {
        std::atomic<std::size_t> missing = 0;  // pixels
        std::vector<std::byte> codes;
        EncodedBand encoded;
        std::atomic<bool> ready = false;  // encoded
        std::shared_ptr<BandFile> in;     // the file that has it, if it is not in memory
    };
    template <class T>
    void put_any(int x, int y, int columns, int rows, const T* values);
    std::byte* codes_of(Band& band, int rows);
    void encode(Band& band, int rows);

    const FileFormat format;
    const std::unique_ptr<Encoder> encoder;
    std::optional<TransferTable> table;  // if the file has 8 bits, of a scene with an assumed_gamma or with an exposure
    std::vector<std::unique_ptr<Band>> bands;
    std::mutex mutex;  // guards the memory of the bands
    std::atomic<std::size_t> bytes_held = 0;
};

}  // namespace strahl
