#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

namespace vcarve {

/// How much of a process is in memory, in bytes.
struct ResidentSize {
    std::int64_t all = 0;
    std::int64_t of_files = 0; ///< pages mapped from files, which can be read back
};

/// As the system tells of this process; nothing where it does not.
std::optional<ResidentSize> resident_size();

/// A thread that, as long as the object lives, looks every 20 ms, or 3 ms where it is above half
/// the limit, at how much of the process is in memory and drops droppable pages where it is more
/// than `most` bytes. Where others fill memory faster than that, the limit is passed by what they
/// fill meanwhile; memory that cannot be dropped is not bounded. Where the cgroup of the process is
/// nearly full the system is also told to write what is dropped, because it may have to wait for
/// that later.
class ResidentLimit {
  public:
    explicit ResidentLimit(std::int64_t most);
    ResidentLimit(const ResidentLimit&) = delete;
    ResidentLimit& operator=(const ResidentLimit&) = delete;
    ~ResidentLimit();

  private:
    void watch();
    bool waits(std::chrono::milliseconds pause);

    std::int64_t most_;
    std::mutex mutex_;
    std::condition_variable ends_;
    bool is_over_ = false;
    std::thread thread_;
};

/// How many bytes of file pages are to be dropped where `most` may be resident: none below the
/// limit; above, as many as bring it well below, so that not every look finds it above again. Some
/// pages always stay, even where other memory alone is above the limit: work would come to a halt.
std::int64_t bytes_to_drop(const ResidentSize& now, std::int64_t most);

} // namespace vcarve
