// The native twin of a live figure's module prints the numbers that both compute.
#include <cstdio>

extern "C" {
int checks();
double check(int number);
double tolerance();
}

int main() {
    std::printf("%.3g\n", tolerance());
    for (int i = 0; i < checks(); ++i) std::printf("%.17g\n", check(i));
}
