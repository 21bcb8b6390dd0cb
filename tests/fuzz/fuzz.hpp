#pragma once

/// \file tests/fuzz/fuzz.hpp
/// \brief What the fuzzers share: files of the bytes they are
/// given, and what may happen.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "ljus/io/file.hpp"

namespace fuzz {

/// The sentence of a refusal: one line of letters that is not too long.
inline void require_sentence(const std::string& text) {
    bool good = !text.empty() && text.size() < 2000 && text.back() == '.';
    for (const char c : text)
        good = good && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
    if (good) return;
    std::fprintf(stderr, "no sentence: '%s'\n", text.c_str());
    std::abort();
}

/// Runs what may be refused with a sentence and in no other way.
template <typename Body>
void refused_or_done(Body&& body) {
    try {
        body();
    } catch (const std::runtime_error& error) {
        require_sentence(error.what());
    } catch (const std::invalid_argument& error) {
        require_sentence(error.what());
    }
}

/// Ends the run with what is not true of a thing that was read.
inline void require_that(bool truth, const char* what) {
    if (truth) return;
    std::fprintf(stderr, "not true: %s\n", what);
    std::abort();
}

/// A file in memory with these bytes, and its path.
class MemoryFile {
public:
    MemoryFile(const std::uint8_t* data, std::size_t size)
        : number_(::memfd_create("fuzz", 0)) {
        require_that(number_ >= 0 && ::write(number_, data, size) == ::ssize_t(size),
                     "a file in memory can be written");
    }
    explicit MemoryFile(const ljus::Bytes& bytes)
        : MemoryFile(bytes.data(), bytes.size()) {}
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(number_); }
    std::string path() const { return "/proc/self/fd/" + std::to_string(number_); }

private:
    int number_;
};

} // namespace fuzz

/// What libFuzzer calls.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
