#pragma once

/// \file ljus/io/detail/stb_memory.hpp
/// \brief Allocates the memory that stb_image_write and stb_image use in png.hpp and
/// load_image.hpp.

#include <cstddef>
#include <cstdlib>
#include <new>

namespace ljus::detail {

// The header of each block of memory, which links the blocks in a circular list.
struct alignas(std::max_align_t) StbBlock {
    StbBlock* before = this;
    StbBlock* next = this;

    void leave() noexcept {
        before->next = next;
        next->before = before;
    }
    void join(StbBlock& after) noexcept {
        before = &after;
        next = after.next;
        before->next = next->before = this;
    }
};

// stb does not report every failed allocation. Here a failed allocation throws
// std::bad_alloc, and stb cannot free its memory. A StbMemory therefore frees, at the
// end of its scope, all blocks that the thread has allocated meanwhile.
class StbMemory {
public:
    StbMemory() noexcept : outer_(list()) { list() = &blocks_; }
    StbMemory(const StbMemory&) = delete;
    StbMemory& operator=(const StbMemory&) = delete;
    ~StbMemory() {
        list() = outer_;
        while (blocks_.next != &blocks_) release(blocks_.next + 1);
    }

    // Like std::realloc, but throws std::bad_alloc.
    static void* resize(void* old, std::size_t size) {
        StbBlock* const from =
            old != nullptr ? static_cast<StbBlock*>(old) - 1 : nullptr;
        if (from != nullptr) from->leave();
        void* const raw =
            std::realloc(static_cast<void*>(from), sizeof(StbBlock) + size);
        if (raw == nullptr) {
            if (from != nullptr) from->join(*from->before);
            throw std::bad_alloc();
        }
        StbBlock* const block = ::new (raw) StbBlock;
        if (list() != nullptr) block->join(*list());
        return block + 1;
    }
    static void release(void* memory) noexcept {
        if (memory == nullptr) return;
        StbBlock* const block = static_cast<StbBlock*>(memory) - 1;
        block->leave();
        std::free(static_cast<void*>(block));
    }

private:
    // The list of the innermost scope on this thread; null outside all scopes.
    static StbBlock*& list() noexcept {
        static thread_local StbBlock* current = nullptr;
        return current;
    }
    StbBlock blocks_;
    StbBlock* outer_;
};

} // namespace ljus::detail
