// What the compiler's pace is measured by: a program of the standard library alone, which
// is parsed, instantiated and optimised as the library's programs are. It must not change:
// the numbers of compile_time.csv are relative to it.
#include <algorithm>
#include <deque>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

template <typename T>
long long sum_of_sorted(std::vector<T> values) {
    std::stable_sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<long long>(values.size());
}

int main(int count, char** words) {
    std::map<std::string, std::vector<int>> places;
    std::unordered_map<std::string, std::set<double>> values;
    std::deque<std::tuple<int, double, std::string>> order;
    for (int i = 0; i < count; ++i) {
        const std::string word = words[i];
        values[word.substr(1)].insert(static_cast<double>(word.size()));
        places[word].push_back(i);
        order.emplace_back(i, static_cast<double>(word.size()), word);
    }
    std::sort(order.begin(), order.end());
    const auto size = static_cast<std::size_t>(count);
    long long sum = sum_of_sorted(std::vector<int>(size, 1)) +
                    sum_of_sorted(std::vector<double>(size, 2)) +
                    sum_of_sorted(std::vector<std::string>(words, words + count));
    for (const auto& [word, at] : places)
        sum += std::accumulate(at.begin(), at.end(), 0LL);
    return static_cast<int>((sum + static_cast<long long>(values.size())) & 127);
}
