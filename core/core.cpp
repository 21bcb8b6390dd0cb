// The library ljus::core: instantiates the templates listed in ljus/core.hpp. Without CMake:
//
//     g++ -std=c++20 -O3 -ffp-contract=off -fopenmp -Iinclude -c core/core.cpp
//     g++ -std=c++20 -O2 -fopenmp -Iinclude -DLJUS_CORE app.cpp core.o
#define LJUS_CORE_EXTERN // neither extern nor inline: defined here
#define LJUS_CORE_INLINE

// The searches are compiled for SSE2, AVX2 and AVX-512, by compilers that can do this for
// templates. A sanitizer would be called before it is ready, when one of them is chosen.
// Without -ffp-contract=off, the last two round a product and a sum once instead of twice,
// and results depend on the processor.
#include <cstddef> // says which C library it is
#if defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) &&                      \
    defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) &&     \
    !defined(__SANITIZE_THREAD__)
#define LJUS_CORE_CLONES                                                               \
    [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4"), gnu::flatten]]
#endif
#include "ljus/core.hpp"
