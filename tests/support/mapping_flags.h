#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace vcarve {

/// The flags of the mapping that begins at `begin` (proc(5), VmFlags): two letters each, with a
/// blank before and after. Empty if there is no such mapping.
inline std::string mapping_flags(const void* begin)
{
    char first[32];
    std::snprintf(first, sizeof(first), "%lx-", reinterpret_cast<std::uintptr_t>(begin));
    std::ifstream smaps("/proc/self/smaps");
    bool is_here = false;
    for (std::string line; std::getline(smaps, line);) {
        if (line.find('-') < line.find(' ')) is_here = line.rfind(first, 0) == 0;
        if (is_here && line.rfind("VmFlags:", 0) == 0) return line.substr(8) + " ";
    }
    return "";
}

} // namespace vcarve
