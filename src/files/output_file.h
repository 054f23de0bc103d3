// Writes whole files, never a part of one. All files that the program writes are written through this.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "files/error.h"

namespace strahl {

/// Writes a file piece by piece; "-" is standard output. A temporary file in the same folder is renamed to `path` once
/// it is on the disk, so that an older file stays intact until then and if anything fails, even by a power cut. When
/// finish() returns, the name is on the disk too. Symbolic links stay links. A file with several names keeps them: it
/// is overwritten in place, with a copy beside it meanwhile. Temporary files that killed programs left in the folder
/// are removed, but not such a copy. An existing file keeps its permissions, except set-user-ID and set-group-ID, and
/// its owner where that is allowed. Devices and pipes are written to directly. Throws OutputError.
class OutputFile {
  public:
    /// `other_program`: another program overwrites the temporary file under its `name()`. Devices and pipes are
    /// refused.
    enum class Writer { own, other_program };
    explicit OutputFile(const std::string& path, Writer writer = Writer::own);
    ~OutputFile();
    /// Gives the file the permissions of another one, and its owner where that is allowed, if that exists.
    void take_permissions(const std::string& of);
    /// Writes the next bytes.
    void append(std::string_view bytes);
    /// The path of the temporary file.
    std::string name() const;
    /// Publishes the file under its name. If it is not called, the temporary file is removed.
    void finish();
    /// Publishes the file under another name in the same folder.
    void finish_as(const std::string& path);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
};

/// Writes a whole file.
void write_file(const std::string& path, std::string_view bytes);

/// Do both paths lead to the same regular file? False for "-", devices and pipes.
bool same_file(const std::string& a, const std::string& b);

/// Throws UsageError if `written`, which `option` names, is the same file as `kept`, which is `what`.
void refuse_overwriting(const std::string& option, const std::string& written, const std::string& what,
                        const std::string& kept);

}  // namespace strahl
