// A picture on its way to a file: pixels come in any order and from any thread; bands that are complete are encoded.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "image/encoder.h"

namespace strahl {

class PictureWriter {
  public:
    /// `named` is the file, or only its ending. Throws OutputError if such a file can't hold this.
    PictureWriter(int width, int height, int channels, const std::string& named, FileFormat format);
    ~PictureWriter();

    /// Values of the pixels from (x, y) on, row by row; the thread that completes a band encodes it. No pixel comes
    /// twice.
    void put(int x, int y, int columns, int rows, const double* values);
    void put(int x, int y, int columns, int rows, const float* values);

    /// Pixels that did not come are black. Throws OutputError.
    void write(const std::string& path);

  private:
    struct Band;
    template <class T>
    void put_any(int x, int y, int columns, int rows, const T* values);
    std::byte* codes_of(Band& band, int rows);
    void encode(int i);

    const FileFormat format;
    const std::unique_ptr<Encoder> encoder;
    std::vector<std::unique_ptr<Band>> bands;
    std::mutex mutex;  // of the bands' memory
};

}  // namespace strahl
