#include "io/files/mapped_file.h"

#include "io/files/foreign_file.h"
#include "vcarve/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace vcarve {

std::string file_problem(const std::filesystem::path& path)
{
    std::error_code error;
    const auto type = std::filesystem::status(path, error).type();
    if (type == std::filesystem::file_type::regular) return "";
    if (type == std::filesystem::file_type::not_found) return "the file does not exist";
    if (type != std::filesystem::file_type::none) return "found something that is not a file";
    return fmt::format("the file cannot be read ({})", error.message());
}

void MappedFile::Unmap::operator()(char* begin) const
{
    munmap(begin, size);
}

MappedFile::Mapping MappedFile::map(const std::filesystem::path& path)
{
    const std::string reason = file_problem(path);
    if (!reason.empty()) throw InputError(fmt::format("{}: {}", path.string(), reason));
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status = {};
    void* begin = MAP_FAILED;
    int error = 0;
    if (file < 0 || fstat(file, &status) != 0) {
        error = errno;
    } else if (status.st_size > 0) { // mmap fails for zero bytes
        begin =
            mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_SHARED, file, 0);
        if (begin == MAP_FAILED) error = errno;
    }
    if (file >= 0) close(file);
    if (error != 0) {
        throw InputError(fmt::format("{}: the file cannot be read ({})", path.string(),
                                     std::generic_category().message(error)));
    }
    if (begin == MAP_FAILED) return Mapping(nullptr, {});
    return Mapping(static_cast<char*>(begin), {static_cast<std::size_t>(status.st_size)});
}

MappedFile::MappedFile(const std::filesystem::path& path) : mapping_(map(path))
{
    refuse_foreign_file(path, bytes());
}

void MappedFile::release(std::size_t count) const
{
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t whole = count / page * page;
    // If madvise fails, the memory is just not released.
    if (whole > 0) static_cast<void>(madvise(mapping_.get(), whole, MADV_DONTNEED));
}

} // namespace vcarve
