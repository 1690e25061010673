// Projected Gauss-Seidel as a plug-in: c++ -O2 -o sweeps sweeps.cpp
#include <algorithm>
#include <cmath>
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
        bool is_solved = false;
        for (int sweep = 0; sweep < 1000 && !is_solved; ++sweep) {
            double change = 0, size = 0;
            bool has_sweeps = true;
            for (size_t i = 0; i < x.size(); ++i) {
                double a = A[i * x.size() + i], w = b[i], old = x[i];
                if (a == 0) { has_sweeps = false; continue; }
                for (size_t j = 0; j < x.size(); ++j) w += A[i * x.size() + j] * x[j];
                x[i] = std::clamp(x[i] - w / a, lo[i], hi[i]);
                change += std::abs(x[i] - old), size += std::abs(x[i]);
            }
            is_solved = has_sweeps && change <= 1e-14 * size;
        }
        std::cout << "{\"x\": [";
        for (size_t i = 0; i < x.size(); ++i) std::cout << (i ? ", " : "") << x[i];
        std::cout << "], \"status\": \"" << (is_solved ? "solved" : "iteration_limit") << "\"}" << std::endl;
    }
}
