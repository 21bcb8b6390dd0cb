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
