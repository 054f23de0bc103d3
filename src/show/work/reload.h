// Reads the scene file again whenever it changes on disk, and writes paths and numbers into it.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pov/open_scene.h"
#include "scene/scene.h"
#include "show/session/edited_text.h"
#include "text/write.h"

namespace strahl {

/// Reads a scene. Throws FileError, also if the scene is too large for float, in which the window traces.
OpenedScene scene_for_window(const std::string& text, const std::string& path, const OpeningOptions& options = {});

/// Says for which moment of its flight, in seconds, and for which size of its picture a scene of POV-Ray is read.
struct ReadFor {
    double seconds = 0;
    int width = 0, height = 0;
};

/// The result of reading a scene file.
struct Loaded {
    std::string path;
    std::shared_ptr<const Scene> scene{};    // null if it has an error, or is still being read
    std::shared_ptr<const Scene> picture{};  // an older scene if that gives the same picture, with the same tracks
    std::string fault{};                     // the message of the error
    std::vector<Message> notes{};            // see OpenedScene
    std::vector<std::string> warnings{};     // of a newly opened scene, see scene_warnings()
    bool opened = false;                     // it is a newly opened file
    bool renamed = false;                    // it is the scene as it was, in another file from now on
    EyeWords words{};                        // of its camera
    bool mirrored = false;                   // see OpenedScene
    bool changes = false;                    // see OpenedScene
    bool sized = false;                      // see OpenedScene
    bool moved = false;                      // the file is the same, read for another moment or size
    ReadFor read_for{};                      // the moment and the size that it was read for
    pov::SourceLines lines{};                // of the bodies of a scene of POV-Ray
    // Holds what the file says; empty if that is more than 16 MB, or a scene of POV-Ray read again for each moment.
    std::string text{};
    std::string tracks{};  // the text of the file of tracks beside it, or empty
};

/// What is to be written into the scene file.
struct ToWrite {
    std::optional<Flythrough> flythrough{};
    bool keeps_path = false;  // keep the file's path, whatever `flythrough` is
    ChangedText changes{};
    bool anyway = false;  // write even if others have changed the file
};

/// The result of writing a path into the scene file, or tracks into the file beside it.
struct Written {
    std::string file{};    // the file that was written
    std::string copy{};    // the name of a copy of the file as it was, if one was made
    bool asks = false;     // nothing was written, because others have changed the file since it was read
    std::string fault{};   // the reason if nothing was written
    bool refused = false;  // a place to which nothing can be written is the reason
    std::string what{};    // of the scene was written: "path", "changes", "path and changes" or "scene"; "" for tracks
    bool unchanged = false;               // nothing was written, because the file has all of it
    bool was_gone = false;                // the file was gone, and is there again
    std::optional<std::string> tracks{};  // the text that the file of tracks has now, if that was written
};

/// The one body in which a text differs from that of a scene, see with_body().
struct ChangedBody {
    std::shared_ptr<const Scene> scene;
    int body = 0;
    std::string context, block;
};

/// Checks the file and those that it includes 30 times a second, in a thread of its own. Waits until a file is
/// completely written. The thread may be left behind in a file that gives no answer, a pipe without a writer or a share
/// without a server: it touches nothing but its `Desk` then.
class Reload {
  public:
    /// Reads `path`, whatever sort of file it is, or standard input for "-". Then watches it, if it is a regular file.
    /// If it is empty there is nothing to read yet.
    explicit Reload(const std::string& path, OpeningOptions options = {});
    /// Waits until everything asked for is written, unless the disk gives no answer.
    ~Reload();
    Reload(const Reload&) = delete;

    /// From now on calls `notify`, from another thread, when there is something to take.
    void listen(std::function<void()> notify);
    /// Reads this file instead, and watches it if it is a valid scene, or if there was none yet.
    void open(std::string path);
    /// Returns what was read last, if it was not taken yet. Waits for it this long.
    std::optional<Loaded> take(double seconds = 0);

    /// Reads a scene of POV-Ray for this moment of its flight and this size of its picture. Those that were not read
    /// yet are skipped.
    void move_to(const ReadFor& moment);
    /// Reads this text as if the file had it, without writing it; of `change`, if given, only the body. Texts that were
    /// not read yet are skipped.
    void show(std::string text, std::optional<ChangedBody> change = {});
    /// Returns the result of that which was read last, if it was not taken yet.
    std::optional<Loaded> take_shown();

    /// Replaces the flythrough and the changed lines in the watched file and leaves the rest as it is; the flythrough
    /// of a scene of POV-Ray goes into a file beside it. Nothing is written if that changes nothing. A file with an
    /// error is never written, nor one in which others have changed the same lines; one that is gone is made again.
    /// FILE~ becomes a copy of the file as it was, unless Strahl wrote that.
    void write(ToWrite wanted);
    /// Writes a text with this flythrough, if it has keys, into another file, and the tracks beside it with these
    /// changes; then watches that file in place of the old one. An empty text is that of the old file. Names of files
    /// in the text are made to lead to the same files.
    void write_as(std::string path, std::string text, std::optional<Flythrough> flythrough, std::vector<Track> tracks);
    /// Writes the keys of these tracks into the file beside the watched one, and keeps a copy, FILE~. The rest of it
    /// stays; tracks without keys are removed.
    void write(std::vector<Track> tracks);
    std::optional<Written> take_written();

  private:
    struct Request {
        ToWrite wanted;
        std::optional<std::vector<Track>> tracks{};  // instead of these, unless there is another path
        std::string path{}, text{};                  // of another file to write instead, or ""
    };
    struct TextToShow {
        std::string text;
        std::optional<ChangedBody> change;
    };
    struct Desk;
    class FileThread;

    std::shared_ptr<Desk> desk;
    std::thread thread;
};

}  // namespace strahl
