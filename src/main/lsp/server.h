// The language server: what an editor asks about the texts that it has open.
#pragma once
#include <iosfwd>

namespace strahl {

/// Answers the messages of an editor until it says `exit` or its stream ends. Returns the exit status: 0 after
/// `shutdown`, else 1. Throws FileError if the stream holds anything else than messages, and OutputError.
///
/// The server speaks the Language Server Protocol 3.17 (microsoft.github.io/language-server-protocol): it publishes
/// errors and warnings, and answers `hover`, `completion` and `definition`. Texts come whole with each change. While
/// one is checked, messages wait; several that wait lead to one check. A text whose last check took more than a second
/// is checked when it is saved, not when it changes.
int serve_editor(std::istream& in, std::ostream& out);

}  // namespace strahl
