// The library ljus::core: instantiates the templates listed in ljus/core.hpp. Without CMake:
//
//     g++ -std=c++20 -O2 -fopenmp -Iinclude -c core/core.cpp
//     g++ -std=c++20 -O2 -fopenmp -Iinclude -DLJUS_CORE app.cpp core.o
#define LJUS_CORE_EXTERN // neither extern nor inline: defined here
#define LJUS_CORE_INLINE
#include "ljus/core.hpp"
