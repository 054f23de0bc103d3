#include "files/os/file.h"

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "files/os/windows/win32.h"

namespace strahl::os {
namespace {

namespace fs = std::filesystem;

constexpr DWORD share_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/// Opens a file, or a folder, which others may meanwhile open, rename and remove.
Descriptor open(const fs::path& path, DWORD access, DWORD how, DWORD more = 0) {
    return descriptor_of(
        ::CreateFileW(path.c_str(), access, share_all, nullptr, how, FILE_ATTRIBUTE_NORMAL | more, nullptr));
}

Descriptor open(const fs::path& path, OpenFile::OpenMode mode) {
    using enum OpenFile::OpenMode;
    if (mode == read) return open(path, GENERIC_READ, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
    return open(path, GENERIC_WRITE, mode == create ? CREATE_NEW : OPEN_EXISTING);
}

std::uint64_t joined(DWORD high, DWORD low) { return std::uint64_t(high) << 32 | low; }

FileStatus status_of(const Descriptor& file) {
    if (!file) return {.error = errno};
    const HANDLE handle = handle_of(file);
    if (::GetFileType(handle) != FILE_TYPE_DISK) return {.type = fs::file_type::unknown, .names = 1};
    BY_HANDLE_FILE_INFORMATION info{};
    if (!::GetFileInformationByHandle(handle, &info)) return {.error = errno_of(::GetLastError())};
    const std::uint64_t size = joined(info.nFileSizeHigh, info.nFileSizeLow),
                        time = joined(info.ftLastWriteTime.dwHighDateTime, info.ftLastWriteTime.dwLowDateTime);
    constexpr std::uint64_t second = 10'000'000;  // in units of Windows' times
    return {
        .type = info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? fs::file_type::directory : fs::file_type::regular,
        .size = size,
        .names = info.nNumberOfLinks,
        .stamp = {info.dwVolumeSerialNumber, joined(info.nFileIndexHigh, info.nFileIndexLow), std::int64_t(size),
                  std::int64_t(time / second), std::int64_t(time % second * 100)}};
}

int set_size(const Descriptor& file, std::uint64_t size) {
    FILE_END_OF_FILE_INFO info{};
    info.EndOfFile.QuadPart = LONGLONG(size);
    return error_of(::SetFileInformationByHandle(handle_of(file), FileEndOfFileInfo, &info, sizeof info));
}

}  // namespace

Descriptor::~Descriptor() {
    if (number > 2) ::_close(number);
}

FileStatus status_of(const fs::path& path) {
    return status_of(open(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS));
}

int writable(const fs::path& path) {
    const bool folder = status_of(path).folder();
    return open(path, folder ? FILE_ADD_FILE : GENERIC_WRITE, OPEN_EXISTING, folder ? FILE_FLAG_BACKUP_SEMANTICS : 0)
               ? 0
               : errno;
}

OpenFile::OpenFile(const fs::path& path, OpenMode mode) : file(open(path, mode)) {}

OpenFile OpenFile::standard_output() {
    std::fflush(stdout);
    return OpenFile(Descriptor(1));
}

FileStatus OpenFile::status() const { return status_of(file); }

int OpenFile::read(std::uint64_t at, char* to, std::size_t& count) const {
    std::size_t done = 0;
    while (done < count) {
        OVERLAPPED place{};
        place.Offset = DWORD(at + done), place.OffsetHigh = DWORD((at + done) >> 32);
        DWORD got = 0;
        const DWORD most = DWORD(std::min<std::size_t>(count - done, 1 << 30));
        if (!::ReadFile(handle_of(file), to + done, most, &got, &place) && ::GetLastError() != ERROR_HANDLE_EOF)
            return errno_of(::GetLastError());
        if (got == 0) break;
        done += got;
    }
    count = done;
    return 0;
}

int OpenFile::append(std::string_view bytes) { return error_of(write_all(file, bytes)); }

int OpenFile::reserve(std::uint64_t, std::uint64_t to) { return set_size(file, to); }

int OpenFile::cut(std::uint64_t size) {
    const int error = set_size(file, size);
    return error ? error : error_of(::SetFilePointerEx(handle_of(file), {}, nullptr, FILE_END));
}

int OpenFile::sync() { return error_of(::FlushFileBuffers(handle_of(file))); }

void OpenFile::take_over(const FileStatus&) {}  // a file has the rights that its folder gives

int OpenFile::lock() {
    // Others cannot read locked bytes: it locks one that no file has.
    OVERLAPPED place{};
    place.OffsetHigh = 0x7fffffff;
    return error_of(
        ::LockFileEx(handle_of(file), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &place));
}

int OpenFile::close() {
    const int number = std::exchange(file.number, -1);
    return number == 1 || ::_close(number) == 0 ? 0 : errno;
}

int rename(const fs::path& from, const fs::path& to) {
    return error_of(::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH));
}

int sync_folder(const fs::path&) { return 0; }  // rename() waits for the disk

}  // namespace strahl::os
