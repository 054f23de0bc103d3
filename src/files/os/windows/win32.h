// Windows' own functions, and what the files of this folder share.
#pragma once
#include <string>
#include <string_view>

#include "files/os/descriptor.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

namespace strahl::os {

/// Returns the errno that says most nearly what an error of Windows says.
int errno_of(DWORD error);
/// Returns 0 for a result that is not 0, or else the errno of the last error.
int error_of(BOOL result);

HANDLE handle_of(const Descriptor& file);
/// Returns a descriptor that owns a handle; an empty one for INVALID_HANDLE_VALUE, with the reason in errno.
Descriptor descriptor_of(HANDLE handle);

/// Makes an empty file that is gone once all its handles are closed.
Descriptor scratch_file(std::wstring& path);
/// Writes all bytes. Returns false if that fails.
bool write_all(const Descriptor& file, std::string_view bytes);

std::wstring utf16(std::string_view utf8);
std::string utf8(std::wstring_view utf16);

}  // namespace strahl::os
