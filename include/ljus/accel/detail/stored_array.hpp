#pragma once

/// \file ljus/accel/detail/stored_array.hpp
/// \brief An array that is not changed any more, in memory or in a mapped file.

#include <cstddef>
#include <span>
#include <utility>

#include "ljus/accel/detail/growing_array.hpp"

namespace ljus::detail {

/// \addtogroup kd_tree8
/// \{

/// Elements in memory, or in a mapped file, which the array unmaps when it ends. A copy
/// of it is in memory.
template <typename Element>
class StoredArray {
public:
    /// Unmaps elements; nothing else does.
    using Unmap = void (*)(std::span<const Element>) noexcept;

    StoredArray() = default;
    /// Takes elements in memory.
    StoredArray(GrowingArray<Element> own) noexcept
        : own_(std::move(own)), elements_(own_.data(), own_.size()) {}
    /// Takes elements in a file.
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

    /// The elements.
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

/// \}

} // namespace ljus::detail
