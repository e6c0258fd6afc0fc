// SPDX-License-Identifier: MIT
#include "common/image/file.hpp"

#include <cerrno>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>

namespace nephroid::examples {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_to_write(const fs::path& path, const std::string& reason) {
    throw std::runtime_error("cannot write '" + path.string() + "': " + reason);
}

/// Why the last stream operation failed; streams say so through errno, on some platforms not at all.
std::string last_reason(const char* otherwise) {
    return errno != 0 ? std::generic_category().message(errno) : std::string(otherwise);
}

/// A file that is removed again unless it is kept.
class TemporaryFile {
public:
    /// Creates it, empty, in the folder of `target`.
    explicit TemporaryFile(const fs::path& target) : target_(target), path_(target) {
        path_ += ".partial-" + std::to_string(std::random_device{}()); // several processes may write one target
        errno = 0;
        stream_.open(path_, std::ios::binary | std::ios::trunc);
        if (!stream_)
            fail_to_write(target_, last_reason("its folder takes no new file"));
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        stream_.close();
        std::error_code ignored; // already renamed, or nothing more can be done
        if (!kept_)
            fs::remove(path_, ignored);
    }

    void write(std::string_view bytes) {
        errno = 0;
        stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        stream_.close(); // what is still buffered meets a full disk here
        if (!stream_)
            fail_to_write(target_, last_reason("the disk does not take all of it"));
    }

    void take_name_of_target() {
        std::error_code error;
        fs::rename(path_, target_, error);
        if (error)
            fail_to_write(target_, error.message());
        kept_ = true;
    }

private:
    fs::path target_, path_;
    std::ofstream stream_;
    bool kept_ = false;
};

/// The file to be written: the path itself or the target of a symbolic link. Refuses files that must not be replaced.
fs::path resolve(const fs::path& path) {
    if (path.empty())
        throw std::runtime_error("cannot write an image: the path is empty");

    std::error_code error;
    fs::path target = path;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
        if (links == 40) // as many as Linux follows
            fail_to_write(path, "too many symbolic links");
        target = target.parent_path() / fs::read_symlink(target, error);
    }

    const fs::file_status status = fs::status(target, error);
    if (fs::is_directory(status))
        fail_to_write(path, "it is a folder");
    if (fs::exists(status)) {
        if (!fs::is_regular_file(status)) // a rename would replace /dev/null by a picture
            fail_to_write(path, "it is not a regular file");
        errno = 0;
        if (!std::ofstream(target, std::ios::binary | std::ios::app)) // appending nothing changes nothing
            fail_to_write(path, last_reason("it takes no output"));
    } else if (!target.has_filename()) {
        fail_to_write(path, "it names a folder, not a file");
    }
    return target;
}

} // namespace

void write_file(const fs::path& path, std::string_view bytes) {
    TemporaryFile file(resolve(path));
    file.write(bytes);
    file.take_name_of_target();
}

void require_writable(const fs::path& path) { const TemporaryFile created_and_removed(resolve(path)); }

} // namespace nephroid::examples
