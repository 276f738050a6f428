#include "cli/run_memory.h"

#include "base/free_memory.h"
#include "base/text.h"
#include "run/job.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

/// A unique path beside the output, or in the temporary folder if the output is a device.
fs::path folder_beside(const fs::path& out)
{
    std::error_code error;
    const bool is_device = fs::is_character_file(out, error);
    fs::path folder = is_device ? fs::temp_directory_path(error) / "colmap-vcarve" : out;
    folder += fmt::format(".scratch-{}", ::getpid());
    return folder;
}

[[noreturn]] void refuse(const fs::path& folder, std::string_view reason)
{
    throw UsageError(fmt::format("cannot use the work folder {}: {}", folder.string(), reason));
}

std::string note_of(const BlockPlan& plan, const fs::path& folder)
{
    const std::string allowed =
        plan.limit == 0 ? "no limit" : byte_size_text(plan.limit) + " allowed";
    return fmt::format("about {} needed, {}: {} blocks, scratch of about {} in {}",
                       byte_size_text(plan.needed), allowed, plan.blocks,
                       byte_size_text(plan.scratch), folder.string());
}

} // namespace

ArrayFolder::ArrayFolder(fs::path given, const fs::path& out)
    : is_temporary_(given.empty()), path_(is_temporary_ ? folder_beside(out) : std::move(given))
{
}

ArrayFolder::~ArrayFolder()
{
    // Scratch files have no names, so the folder is empty unless another program uses it.
    std::error_code ignored;
    if (is_temporary_) fs::remove(path_, ignored);
}

void ArrayFolder::prepare(std::int64_t bytes) const
{
    std::error_code error;
    const fs::file_status status = fs::status(path_, error);
    if (fs::exists(status) && !fs::is_directory(status)) refuse(path_, "it is not a folder");
    fs::create_directory(path_, error);
    if (error) refuse(path_, error.message());
    if (::access(path_.c_str(), W_OK | X_OK) != 0) refuse(path_, std::strerror(errno));
    const std::optional<std::int64_t> free = free_space(path_);
    if (free && *free < bytes) {
        refuse(path_, fmt::format("{} are free there, but about {} are needed",
                                  byte_size_text(*free), byte_size_text(bytes)));
    }
}

std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted)
{
    if (wanted.limit == 0) return std::nullopt;
    if (wanted.limit != MemoryOptions::kAutoMemory) return wanted.limit;
    const std::optional<std::int64_t> free = free_memory();
    if (!free) return std::nullopt;
    return *free / 5 * 4;
}

Options options_of_tiles(const Options& given)
{
    Options options = given;
    options.memory = {.limit = allowed_memory(given.memory).value_or(0), .blocks = 0};
    return options;
}

RunMemory::RunMemory(const MemoryOptions& wanted, int threads, const ArrayFolder& folder)
    : wanted_(wanted), threads_(threads), folder_(folder), free_(free_memory())
{
    if (!folder.is_temporary()) folder.prepare(0);
}

void RunMemory::fit(const RunSize& size, Log& log)
{
    const BlockPlan before = std::exchange(plan_, plan_blocks(size, threads_, wanted_, free_));
    // Arrays in files stay there, even if the thinned cloud would fit into memory.
    if (before.in_blocks() && !plan_.in_blocks()) plan_ = before;
    if (!plan_.in_blocks()) return;
    if (before.blocks != plan_.blocks) log.note(note_of(plan_, folder_.path()));
    if (scratch_) return;
    folder_.prepare(plan_.scratch);
    constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
    scratch_.emplace(folder_.path(), plan_.limit == 0 ? kNoLimit : plan_.limit);
}

MemoryOptions RunMemory::options() const
{
    MemoryOptions options = wanted_;
    options.blocks = plan_.blocks;
    // The limit also applies to growth that cannot be predicted.
    if (wanted_.blocks != 0 && wanted_.limit == MemoryOptions::kAutoMemory)
        options.limit = plan_.limit;
    return options;
}

Json RunMemory::record() const
{
    return {{"blocks", plan_.blocks},
            {"needed_bytes", plan_.needed},
            {"allowed_bytes", plan_.limit},
            {"expected_scratch_bytes", plan_.scratch},
            {"scratch_bytes", ScratchMemory::peak_bytes()}};
}

Digest digest_of_options(const Options& options)
{
    Job facts = option_facts(options);
    facts.push_back(program_fact());
    return digest_of(facts);
}

} // namespace vcarve::cli
