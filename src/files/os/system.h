// The program's own files, its libraries, and the system that it runs on.
#pragma once
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace strahl::os {

/// Returns a path at which the program's own file can be read, even if that was replaced since it started.
std::string program_file();
/// Returns the folder of the program.
std::filesystem::path program_folder();
/// Returns the folders in which programs such as POV-Ray keep files for their users.
std::vector<std::filesystem::path> shared_folders();
/// Returns the shared libraries that the program has loaded so far.
std::vector<std::filesystem::path> loaded_libraries();
/// Returns the system that this program is for: "Linux".
const char* system_name();
/// Returns where this program can run: "Linux on x86_64 with glibc 2.36 or later".
std::string system_needed();

/// Loads a shared library, for good: those behind it do not all survive being unloaded.
class Library {
  public:
    explicit Library(const std::string& path);
    /// Says why it does not load, or is empty.
    const std::string& fault() const { return why; }
    /// Returns a function of the library, or null if it has none of this name or was not loaded.
    template <class Function>
    Function* function(const char* name) const {
        return reinterpret_cast<Function*>(find(name));
    }

  private:
    void* find(const char* name) const;

    void* handle;
    std::string why;
};

/// Makes standard streams read and write bytes as they are, and a terminal show UTF-8 and colours. For main().
void prepare_streams();
/// Is this stream a terminal?
bool is_terminal(std::FILE* stream);
/// Returns the number of columns of the terminal on standard output, or what COLUMNS says; 0 if there is neither.
int terminal_columns();
/// Sets an environment variable, unless the user has.
void set_variable(const char* name, const char* value);
/// Returns a moment as the clock of this place shows it.
std::tm local_time(std::time_t moment);

}  // namespace strahl::os
