#pragma once

/// \file ljus/accel/detail/stored_array.hpp
/// \brief Large arrays: one that grows without being in memory twice, and one that is
/// not changed any more, in memory or in a mapped file.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "ljus/version.hpp"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace ljus::detail {

/// Gives freed memory back to the system. glibc keeps small pieces that were freed for
/// further small pieces, and does not make a large array of them.
inline void give_back_memory() noexcept {
#ifdef __GLIBC__
    ::malloc_trim(0);
#endif
}

/// An array of numbers. It grows by std::realloc(), which in Linux moves the pages of a
/// large array instead of copying them. A std::vector is in memory twice while it
/// grows, or reserves all its memory before any of it is used.
template <typename Element>
class GrowingArray {
    static constexpr std::size_t alignment = 32; // a pointer of malloc() has less
    static_assert(std::is_trivially_copyable_v<Element> &&
                  alignof(Element) <= alignment);

public:
    GrowingArray() = default;
    explicit GrowingArray(std::span<const Element> elements) {
        resize(elements.size());
        if (size_ > 0)
            std::memcpy(static_cast<void*>(data_), elements.data(),
                        elements.size_bytes());
    }
    GrowingArray(GrowingArray&& other) noexcept
        : memory_(std::exchange(other.memory_, nullptr)),
          data_(std::exchange(other.data_, nullptr)),
          size_(std::exchange(other.size_, 0)), room_(std::exchange(other.room_, 0)) {}
    GrowingArray& operator=(GrowingArray&& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(room_, other.room_);
        return *this;
    }
    ~GrowingArray() { std::free(memory_); }

    /// Changes the number of elements; new ones are not initialised.
    void resize(std::size_t count) {
        if (count > room_) take(count < room_ + room_ / 8 ? room_ + room_ / 8 : count);
        size_ = count;
    }
    /// Gives the memory behind the last element back.
    void shrink_to_fit() {
        if (size_ < room_) take(size_);
    }

    [[nodiscard]] Element* data() noexcept { return data_; }
    [[nodiscard]] const Element* data() const noexcept { return data_; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] Element& operator[](std::size_t i) noexcept { return data_[i]; }
    [[nodiscard]] const Element& operator[](std::size_t i) const noexcept {
        return data_[i];
    }

private:
    // The distance from a pointer to the next one that is aligned.
    [[nodiscard]] static std::size_t shift(const void* pointer) noexcept {
        return (~reinterpret_cast<std::uintptr_t>(pointer) + 1) % alignment;
    }
    // Makes room for some elements, not fewer than there are.
    void take(std::size_t room) {
        if (room > (static_cast<std::size_t>(-1) - alignment) / sizeof(Element))
            throw std::bad_alloc();
        const std::size_t before = shift(memory_);
        void* const moved = std::realloc(memory_, room * sizeof(Element) + alignment);
        if (moved == nullptr) throw std::bad_alloc();
        memory_ = static_cast<char*>(moved);
        const std::size_t now = shift(memory_);
        if (now != before)
            std::memmove(memory_ + now, memory_ + before, size_ * sizeof(Element));
        data_ = reinterpret_cast<Element*>(memory_ + now);
        room_ = room;
    }

    char* memory_ = nullptr;  // of malloc()
    Element* data_ = nullptr; // in it, aligned
    std::size_t size_ = 0;
    std::size_t room_ = 0;
};

/// Elements in memory, or in a mapped file, which the array unmaps when it ends. A copy
/// of it is in memory.
template <typename Element>
class StoredArray {
public:
    /// Unmaps elements; nothing else does.
    using Unmap = void (*)(std::span<const Element>) noexcept;

    StoredArray() = default;
    StoredArray(GrowingArray<Element> own) noexcept
        : own_(std::move(own)), elements_(own_.data(), own_.size()) {}
    StoredArray(std::span<const Element> mapped, Unmap unmap) noexcept
        : elements_(mapped), unmap_(unmap) {}
    StoredArray(const StoredArray& other)
        : StoredArray(GrowingArray<Element>(other.elements_)) {}
    StoredArray(StoredArray&& other) noexcept
        : own_(std::move(other.own_)), elements_(std::exchange(other.elements_, {})),
          unmap_(std::exchange(other.unmap_, nullptr)) {}
    StoredArray& operator=(StoredArray other) noexcept {
        std::swap(own_, other.own_);
        std::swap(elements_, other.elements_);
        std::swap(unmap_, other.unmap_);
        return *this;
    }
    ~StoredArray() {
        if (unmap_ != nullptr) unmap_(elements_);
    }

    [[nodiscard]] std::span<const Element> span() const noexcept { return elements_; }
    [[nodiscard]] const Element& operator[](std::size_t i) const noexcept {
        return elements_[i];
    }
    [[nodiscard]] const Element* data() const noexcept { return elements_.data(); }
    [[nodiscard]] std::size_t size() const noexcept { return elements_.size(); }
    [[nodiscard]] bool empty() const noexcept { return elements_.empty(); }

private:
    GrowingArray<Element> own_; // empty if the elements are in a file
    std::span<const Element> elements_;
    Unmap unmap_ = nullptr;
};

} // namespace ljus::detail
