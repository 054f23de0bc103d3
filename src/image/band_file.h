// Files of encoded bands: the checkpoint of a picture that is not finished, or a part of a picture.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "files/os/file.h"
#include "image/encoder.h"

namespace strahl {

/// The first lines of a file of bands, each a key, a space and a value. Bands belong to the same picture if all lines
/// but the part are equal.
struct BandHeader {
    std::string program, scene, options;  // two hashes, and in words all else that the picture depends on
    std::string ending;
    Layout layout;
    Compression compression = Compression::fast;
    int part = 1, parts = 1;  // the bands whose numbers leave `part` - 1 when divided by `parts`

    std::string text() const;
    /// The first key whose values differ, or "" if there is none.
    std::string difference(const BandHeader& other) const;
    bool has(int band) const { return band % parts == part - 1; }
};

/// A file of bands. Whatever happened while it was written, each band is whole or absent: anything after the last whole
/// band is ignored. Functions that write throw OutputError, those that read FileError.
class BandFile {
  public:
    /// Opens the file at `path` and finds its bands.
    explicit BandFile(const std::string& path);
    /// Begins a file, in place of an older one.
    BandFile(const std::string& path, const BandHeader& header);

    /// Is the file at this path one of bands?
    static bool is_at(const std::string& path);

    const BandHeader& header() const { return own_header; }
    const std::string& path() const { return own_path; }
    bool has(int band) const { return records.contains(band); }
    const std::string& note(int band) const { return records.at(band).note; }
    std::string bytes(int band) const;

    /// Locks the file. Throws OutputError if another program has locked it.
    void open_to_append();
    void append(int band, const EncodedBand& encoded);
    /// When this returns, all bands are on the disk.
    void sync();
    /// Gives it another name, under which it is on the disk when this returns.
    void rename(const std::string& path);

  private:
    struct Record {
        std::uint64_t at, size;  // of the bytes of a band in the file
        std::string note;
    };
    std::string own_path;
    BandHeader own_header;
    std::map<int, Record> records;  // by number of the band
    std::uint64_t end = 0;          // of the last whole band
    os::OpenFile file;              // open for appending, or closed
};

}  // namespace strahl
