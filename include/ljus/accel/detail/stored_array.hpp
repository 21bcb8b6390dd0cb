#pragma once

/// \file ljus/accel/detail/stored_array.hpp
/// \brief Large arrays that grow without being in memory twice, or that are in a file.

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

/// Gives freed memory back to the system. glibc would keep freed small pieces, and
/// cannot use them for a large array.
inline void give_back_memory() noexcept {
#ifdef __GLIBC__
    ::malloc_trim(0);
#endif
}

/// Memory from std::malloc(), and an aligned address in it.
struct AlignedMemory {
    static constexpr std::size_t alignment = 32; ///< The alignment in bytes.
    char* start = nullptr;                       ///< The result of malloc().
    char* place = nullptr;                       ///< The first aligned address.

    /// Changes the size of the memory. This function is not a template, so that arrays
    /// of all types share it.
    /// \param kept  The number of bytes from `place` on that keep their values.
    /// \param size  The new size in bytes, at least `kept`.
    /// \throws std::bad_alloc  if there is not enough memory.
    void take(std::size_t kept, std::size_t size);
};

// The distance in bytes from a pointer to the next aligned address.
[[nodiscard]] inline std::size_t to_aligned(const void* pointer) noexcept {
    return (~reinterpret_cast<std::uintptr_t>(pointer) + 1) % AlignedMemory::alignment;
}

[[gnu::cold]] inline void AlignedMemory::take(std::size_t kept, std::size_t size) {
    const std::size_t before = to_aligned(start);
    void* const moved = size > static_cast<std::size_t>(-1) - alignment
                            ? nullptr
                            : std::realloc(static_cast<void*>(start), size + alignment);
    if (moved == nullptr) throw std::bad_alloc();
    start = static_cast<char*>(moved);
    place = start + to_aligned(start);
    if (place != start + before) std::memmove(place, start + before, kept);
}

/// An array of trivially copyable elements. It grows by std::realloc(), which in Linux
/// moves the pages of a large array instead of copying them. A std::vector is in memory
/// twice while it grows, and compiles more slowly.
template <typename Element>
class GrowingArray {
    static_assert(std::is_trivially_copyable_v<Element> &&
                  alignof(Element) <= AlignedMemory::alignment);

public:
    GrowingArray() = default;
    /// Makes `count` elements that are not initialised.
    explicit GrowingArray(std::size_t count) { resize(count); }
    explicit GrowingArray(std::span<const Element> elements) {
        resize(elements.size());
        if (size_ > 0)
            std::memcpy(static_cast<void*>(data()), elements.data(),
                        elements.size_bytes());
    }
    GrowingArray(const GrowingArray& other)
        : GrowingArray(std::span<const Element>(other.data(), other.size())) {}
    GrowingArray(GrowingArray&& other) noexcept
        : memory_(std::exchange(other.memory_, {})),
          size_(std::exchange(other.size_, 0)), room_(std::exchange(other.room_, 0)) {}
    GrowingArray& operator=(const GrowingArray& other) {
        return *this = GrowingArray(other);
    }
    GrowingArray& operator=(GrowingArray&& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(size_, other.size_);
        std::swap(room_, other.room_);
        return *this;
    }
    ~GrowingArray() {
        if (memory_.start != nullptr) std::free(memory_.start); // most are empty
    }

    /// Changes the number of elements; new ones are not initialised.
    void resize(std::size_t count) {
        if (count > room_) take(count < room_ + room_ / 8 ? room_ + room_ / 8 : count);
        size_ = count;
    }
    /// Makes room for `count` elements.
    void reserve(std::size_t count) {
        if (count > room_) take(count);
    }
    /// Adds an element that is not initialised.
    [[nodiscard]] Element& add() {
        if (size_ == room_) take(room_ < 16 ? 16 : 2 * room_);
        return data()[size_++];
    }
    /// Adds a copy of an element. The argument must not refer to an element of this
    /// array.
    void push_back(const Element& element) { add() = element; }
    /// Removes all elements, and keeps their memory.
    void clear() noexcept { size_ = 0; }
    /// Frees the memory behind the last element.
    void shrink_to_fit() {
        if (size_ < room_) take(size_);
    }

    [[nodiscard]] Element* data() noexcept {
        return reinterpret_cast<Element*>(memory_.place);
    }
    [[nodiscard]] const Element* data() const noexcept {
        return reinterpret_cast<const Element*>(memory_.place);
    }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return room_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] Element* begin() noexcept { return data(); }
    [[nodiscard]] Element* end() noexcept { return data() + size_; }
    [[nodiscard]] const Element* begin() const noexcept { return data(); }
    [[nodiscard]] const Element* end() const noexcept { return data() + size_; }
    [[nodiscard]] Element& operator[](std::size_t i) noexcept { return data()[i]; }
    [[nodiscard]] const Element& operator[](std::size_t i) const noexcept {
        return data()[i];
    }

private:
    // Changes the capacity to `room` elements, at least size().
    void take(std::size_t room) {
        constexpr std::size_t all = static_cast<std::size_t>(-1);
        memory_.take(size_ * sizeof(Element),
                     room > all / sizeof(Element) ? all : room * sizeof(Element));
        room_ = room;
    }

    AlignedMemory memory_{};
    std::size_t size_ = 0;
    std::size_t room_ = 0;
};

/// A constant array, in memory or in a mapped file. The destructor unmaps the file. To
/// copy the array means to copy its elements into memory.
template <typename Element>
class StoredArray {
public:
    /// A function that unmaps the elements of a file.
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
    StoredArray& operator=(const StoredArray& other) {
        return *this = StoredArray(other);
    }
    StoredArray& operator=(StoredArray&& other) noexcept {
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
