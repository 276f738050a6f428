#include "io/files/mapped_file.h"

#include "io/files/foreign_file.h"
#include "vcarve/error.h"

#include <boost/interprocess/exceptions.hpp>
#include <boost/interprocess/file_mapping.hpp>
#include <fmt/format.h>
#include <sys/mman.h>

#include <system_error>

namespace vcarve {

namespace bip = boost::interprocess;

namespace {

bip::mapped_region map_file(const std::filesystem::path& path)
{
    const std::string reason = why_no_file(path);
    if (!reason.empty()) throw InputError(fmt::format("{}: {}", path.string(), reason));
    try {
        const bip::file_mapping file(path.c_str(), bip::read_only);
        // No system maps zero bytes
        if (std::filesystem::file_size(path) == 0) return {};
        return {file, bip::read_only};
    } catch (const bip::interprocess_exception& failure) {
        throw InputError(
            fmt::format("{}: the file cannot be read ({})", path.string(), failure.what()));
    }
}

} // namespace

std::string why_no_file(const std::filesystem::path& path)
{
    std::error_code error;
    const auto type = std::filesystem::status(path, error).type();
    if (type == std::filesystem::file_type::regular) return "";
    if (type == std::filesystem::file_type::not_found) return "the file does not exist";
    if (type != std::filesystem::file_type::none) return "found something that is not a file";
    return fmt::format("the file cannot be read ({})", error.message());
}

MappedFile::MappedFile(const std::filesystem::path& path)
    : region_(map_file(path)), pages_(region_.get_address(), region_.get_size())
{
    refuse_foreign_file(path, bytes());
}

std::span<const char> MappedFile::bytes() const
{
    return {static_cast<const char*>(region_.get_address()), region_.get_size()};
}

void MappedFile::release(std::size_t count) const
{
    const std::size_t page = bip::mapped_region::get_page_size();
    const std::size_t whole = count / page * page;
    // It only costs memory where the system will not.
    if (whole > 0) static_cast<void>(madvise(region_.get_address(), whole, MADV_DONTNEED));
}

} // namespace vcarve
