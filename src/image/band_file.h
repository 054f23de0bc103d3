// Encoded bands of a picture in a file: the checkpoint of a picture that is not finished, or a part of one.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "image/encoder.h"

namespace strahl {

/// What a file of bands is of: lines of a key, a space and a value. Bands go together if all of this is the same but
/// the part.
struct BandHeader {
    std::string program, scene, options;  // hashes, and in words whatever else the picture depends on
    std::string ending;
    Layout layout;
    Compression compression = Compression::fast;
    int part = 1, parts = 1;  // the bands whose numbers leave `part` - 1 when divided by `parts`

    std::string text() const;
    /// The first key whose values differ, or "".
    std::string difference(const BandHeader& other) const;
    bool has(int band) const { return band % parts == part - 1; }
};

/// Each band is whole or absent in it, whatever happened while it was written: what follows the last band that is whole
/// is ignored. Functions throw OutputError where they write and FileError where they read.
class BandFile {
  public:
    /// Reads what is in the file at `path`.
    explicit BandFile(const std::string& path);
    /// Begins one, in the place of an older one.
    BandFile(const std::string& path, const BandHeader& header);
    ~BandFile();
    BandFile(const BandFile&) = delete;

    /// Is there such a file?
    static bool is_at(const std::string& path);

    const BandHeader& header() const { return own_header; }
    const std::string& path() const { return own_path; }
    bool has(int band) const { return places.contains(band); }
    const std::string& note(int band) const { return places.at(band).note; }
    std::string bytes(int band) const;

    /// Locks the file; OutputError if another program has.
    void open_to_append();
    void append(int band, const EncodedBand& encoded);
    /// When this returns, all bands are on the disk.
    void sync();
    /// Gives it another name, under which it is on the disk when this returns.
    void rename(const std::string& path);

  private:
    struct Place {
        std::uint64_t at, size;
        std::string note;
    };
    std::string own_path;
    BandHeader own_header;
    std::map<int, Place> places;
    std::uint64_t end = 0;  // of the last band that is whole
    int file = -1;          // open to append
};

}  // namespace strahl
