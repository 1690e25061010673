// Projected Gauss-Seidel as a plug-in: c++ -O2 -o sweeps sweeps.cpp
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

// All numbers of the list under a key, "inf" and "-inf" included, however deep it is nested.
std::vector<double> numbers(const std::string& line, const std::string& key) {
    std::vector<double> found;
    size_t at = line.find("\"" + key + "\":") + key.size() + 3;
    for (int depth = 0; at < line.size();) {
        char c = line[at];
        depth += (c == '[') - (c == ']');
        if (c == ']' && depth == 0) break;
        char* end = nullptr;
        double value = std::strchr("[], {}:\"", c) ? 0 : std::strtod(&line[at], &end);
        if (end && end != &line[at]) { found.push_back(value); at = end - line.data(); }
        else ++at;
    }
    return found;
}

int main() {
    std::cout << std::setprecision(17);
    for (std::string line; std::getline(std::cin, line);) {
        auto A = numbers(line, "dense"), b = numbers(line, "b");
        auto lo = numbers(line, "lo"), hi = numbers(line, "hi");
        std::vector<double> x(b.size());
        for (int sweep = 0; sweep < 1000; ++sweep)
            for (size_t i = 0; i < x.size(); ++i) {
                if (A[i * x.size() + i] == 0) continue;  // such a row has no sweep
                double w = b[i];
                for (size_t j = 0; j < x.size(); ++j) w += A[i * x.size() + j] * x[j];
                x[i] = std::clamp(x[i] - w / A[i * x.size() + i], lo[i], hi[i]);
            }
        std::cout << "{\"x\": [";
        for (size_t i = 0; i < x.size(); ++i) std::cout << (i ? ", " : "") << x[i];
        bool has_sweeps = true;
        for (size_t i = 0; i < x.size(); ++i) has_sweeps &= A[i * x.size() + i] != 0;
        std::cout << (has_sweeps ? "]}" : "], \"status\": \"iteration_limit\"}") << std::endl;
    }
}
