// Whole files out, never half of one: every file that the program writes goes through here.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "scene/error.h"

namespace strahl {

/// The new content of the file `path`, piece by piece; "-" is standard output. A temporary file in the same folder is
/// renamed over `path` once it is on the disk, so that an older file stays as it was until then and if anything fails,
/// a power cut included. When finish() returns, the name is on the disk too. Symbolic links stay links. A file with
/// several names keeps them: it is overwritten in place, with a copy beside it meanwhile. Temporary files that killed
/// programs left in the folder are removed, but not such a copy. An existing file keeps its permissions, but for
/// set-user-ID and set-group-ID, and its owner where we may give it away. Devices and pipes are written to directly.
/// Throws OutputError.
class OutputFile {
  public:
    /// Another program overwrites the temporary file by its `name()`, and goes on when this one is killed: the file
    /// then stays. Devices and pipes are refused.
    enum class Writer { own, other_program };
    explicit OutputFile(const std::string& path, Writer writer = Writer::own);
    ~OutputFile();
    void append(std::string_view bytes);
    /// The temporary file's.
    std::string name() const;
    /// Nothing has the name before; without it nothing is left.
    void finish();
    /// The same under another name in the same folder.
    void finish_as(const std::string& path);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
};

/// All of a file at once.
void write_file(const std::string& path, std::string_view bytes);

/// Removes a folder and all that is in it, as far as it can. If something stays, errno says why.
bool remove_folder(const std::string& path);

/// Would bytes written to one of these paths be in the way of the other's? Not of "-", devices and pipes.
bool same_file(const std::string& a, const std::string& b);

/// Throws UsageError if `written`, which `option` names, is the same file as `kept`, which is `what`.
void refuse_overwriting(const std::string& option, const std::string& written, const std::string& what,
                        const std::string& kept);

}  // namespace strahl
