#include "files/os/windows/win32.h"

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace strahl::os {

int errno_of(DWORD error) {
    switch (error) {
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
        case ERROR_INVALID_NAME:
        case ERROR_INVALID_DRIVE:
        case ERROR_BAD_NETPATH:
            return ENOENT;
        case ERROR_FILE_EXISTS:
        case ERROR_ALREADY_EXISTS:
            return EEXIST;
        case ERROR_ACCESS_DENIED:
        case ERROR_SHARING_VIOLATION:
            return EACCES;
        case ERROR_LOCK_VIOLATION:
        case ERROR_IO_PENDING:
            return EWOULDBLOCK;
        case ERROR_DISK_FULL:
        case ERROR_HANDLE_DISK_FULL:
            return ENOSPC;
        case ERROR_BROKEN_PIPE:
        case ERROR_NO_DATA:
            return EPIPE;
        case ERROR_NOT_ENOUGH_MEMORY:
        case ERROR_OUTOFMEMORY:
            return ENOMEM;
        case ERROR_WRITE_PROTECT:
            return EROFS;
        case ERROR_FILENAME_EXCED_RANGE:
            return ENAMETOOLONG;
        default:
            return EIO;
    }
}

int error_of(BOOL result) { return result ? 0 : errno_of(::GetLastError()); }

HANDLE handle_of(const Descriptor& file) { return reinterpret_cast<HANDLE>(::_get_osfhandle(file.number)); }

Descriptor descriptor_of(HANDLE handle) {
    if (handle != INVALID_HANDLE_VALUE) return ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY);
    errno = errno_of(::GetLastError());
    return {};
}

Descriptor scratch_file(std::wstring& path) {
    wchar_t folder[MAX_PATH + 1], name[MAX_PATH + 1];
    if (!::GetTempPathW(MAX_PATH, folder) || !::GetTempFileNameW(folder, L"str", 0, name)) {
        errno = errno_of(::GetLastError());
        return {};
    }
    path = name;
    return descriptor_of(::CreateFileW(name, GENERIC_READ | GENERIC_WRITE,
                                       FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, CREATE_ALWAYS,
                                       FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr));
}

bool write_all(const Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        DWORD written = 0;
        const DWORD most = DWORD(std::min<std::size_t>(bytes.size(), 1 << 30));
        if (!::WriteFile(handle_of(file), bytes.data(), most, &written, nullptr)) return false;
        bytes.remove_prefix(written);
    }
    return true;
}

std::wstring utf16(std::string_view utf8) {
    const int size = ::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), int(utf8.size()), nullptr, 0);
    std::wstring text(std::size_t(size), L'\0');
    ::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), int(utf8.size()), text.data(), size);
    return text;
}

std::string utf8(std::wstring_view utf16) {
    const int size = ::WideCharToMultiByte(CP_UTF8, 0, utf16.data(), int(utf16.size()), nullptr, 0, nullptr, nullptr);
    std::string text(std::size_t(size), '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, utf16.data(), int(utf16.size()), text.data(), size, nullptr, nullptr);
    return text;
}

}  // namespace strahl::os
