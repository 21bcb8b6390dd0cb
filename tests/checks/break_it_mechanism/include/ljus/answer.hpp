#pragma once

#include <cstdlib>
#include <string>

inline int answer() {
    return 42;
}
inline int question() {
    return 6;
}
inline std::string text() {
    return "a;b" + std::string("[${x}]\\");
}
constexpr int seven() {
    return 7;
}
inline constexpr int always_seven = seven();

template <typename T = int>
struct alignas(16) Field {
    int size, sides = 4;
    explicit Field(T of) : size{of} {}
    int above(const T& low = T{1'000}) const noexcept {
        const auto next = [](T x) { // with a } that closes nothing
            return x + 1;
        };
        if (low == '{') return next(low);
        return size;
    }
};
