#pragma once

/// \file ljus/ref.hpp
/// \brief A reference that refuses temporaries.

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup ref References
/// \brief A constructor that stores a reference to its argument takes a Ref.
/// \{

/// A reference to an object, which must outlive the reference. A temporary does not
/// compile, because its lifetime would end before the reference is used.
template <typename X>
class Ref {
public:
    /// Refers to an object with a name.
    constexpr Ref(const X& object) noexcept : object_(&object) {}
    Ref(const X&&) = delete; ///< A temporary ends too early: give the object a name.

    /// The object.
    [[nodiscard]] constexpr const X& get() const noexcept { return *object_; }

private:
    const X* object_;
};

/// \}

} // namespace ljus
