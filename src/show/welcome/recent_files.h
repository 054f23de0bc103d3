// Remembers the scenes that were opened last, from one start to the next.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// How many scenes are remembered.
inline constexpr std::size_t most_recent_files = 12;

/// Returns $XDG_STATE_HOME/strahl/recent, by default ~/.local/state/strahl/recent, see user_file(). It has an absolute
/// path in each line, that of the last scene first.
std::string recent_files_file();

/// Returns the paths in the text of such a file. Lines that are no absolute paths are skipped.
std::vector<std::string> recent_files_in(std::string_view text);
/// Returns these paths with those that were opened since, the last one of which becomes the first.
std::vector<std::string> with_recent(std::vector<std::string> recent, const std::vector<std::string>& opened);

/// Returns what was written last. Empty if there is no valid file.
std::vector<std::string> read_recent_files();
/// Adds the scenes that were opened, in the order of that, to the file. Standard input is none. Errors are ignored:
/// then they are forgotten.
void remember_recent_files(const std::vector<std::string>& opened);

}  // namespace strahl
