#include "answer_test.cpp"
