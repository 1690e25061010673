// lcplab_dump.h: writes the constraints of one step of an engine as a problem file of lcplab.
// C++11, no dependencies, one header. MIT OR Apache-2.0.
//
//     lcplab::Frame frame("frame 12");
//     int box = frame.body("box", mass, inertia, target);        // target: u*, see below
//     int n = frame.row("normal box floor", "normal", 0, infinity);
//     frame.entry(n, box, linear, angular);                      // the row of J for this body
//     frame.answer(n, impulse);                                  // what your solver computed
//     frame.moved(box, velocity, angular_velocity);              // the velocity after the step
//     frame.write("frame.json", "frame.x.json");                 // lcplab judge frame.json frame.x.json
//
// The problem is w = A x + b with lo <= x <= hi, where w > 0 only at x = lo and w < 0 only at x = hi:
//
//     A = J inv(M) J^T + diag(compliance),   b = J u* + bias
//
// u* holds the velocities (m/s, rad/s) that the bodies would have after the step without constraints, that is, after
// gravity and other forces; then x are impulses (N s). A row pushes with x >= 0 where J u grows as the gap opens.
// bias is added to J u*: gap / dt for a contact that may still close, minus the velocity that a correction of
// positions or a bounce asks for. Angular velocities, inertias and J are in world axes.
#ifndef LCPLAB_DUMP_H
#define LCPLAB_DUMP_H

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace lcplab {

typedef std::array<double, 3> Vec3;
typedef std::array<Vec3, 3> Mat3;
typedef std::array<double, 6> Six;

const double infinity = std::numeric_limits<double>::infinity();
/// The number of a body that does not move; entries for it are ignored.
const int fixed_body = -1;

/// The bodies and rows of one step.
class Frame {
public:
    /// A name for messages, the length of the step (s), 0 if unknown, and 32 if the engine computes with floats.
    explicit Frame(const std::string& name = "frame", double dt = 0, int bits = 64) : name_(name), dt_(dt), bits_(bits) {}

    /// Adds a moving body and returns its number: mass (kg), inertia about the center of mass (kg m^2, world axes),
    /// and u*, the linear (m/s) and angular velocity (rad/s) without constraints.
    int body(const std::string& name, double mass, const Mat3& inertia, const Vec3& linear, const Vec3& angular) {
        bodies_.push_back(Body{name, mass, inertia, inverse(inertia), linear, angular, {}});
        return static_cast<int>(bodies_.size()) - 1;
    }

    /// Adds a row and returns its number. An equation has the bounds -infinity and infinity; kind is a word such as
    /// "normal", "friction", "joint", "limit" or "motor".
    int row(const std::string& label, const std::string& kind, double lo, double hi, double bias = 0,
            double compliance = 0) {
        rows_.push_back(Row{label, kind, lo, hi, bias, compliance, 0, fixed_body, 0, {}});
        return static_cast<int>(rows_.size()) - 1;
    }

    /// Adds a row of friction: |x| <= mu * x[normal].
    int friction(const std::string& label, int normal, double mu, double bias = 0) {
        int number = row(label, "friction", -infinity, infinity, bias);
        rows_[number].normal = normal;
        rows_[number].mu = mu;
        return number;
    }

    /// Adds to row i of J the entries of one body: J u = linear . v + angular . omega.
    void entry(int i, int body, const Vec3& linear, const Vec3& angular) {
        if (body == fixed_body) return;
        Six& sum = rows_[i].entries[body]; // zeros if it is new
        for (int k = 0; k < 3; ++k) sum[k] += linear[k], sum[3 + k] += angular[k];
    }

    /// Adds the entries of a row along a direction through a point: it moves body b against body a. r_a and r_b are
    /// the arms from the centers of mass to the point.
    void along(int i, const Vec3& direction, int a, const Vec3& r_a, int b, const Vec3& r_b) {
        const Vec3 minus = {{-direction[0], -direction[1], -direction[2]}};
        entry(i, a, minus, cross(r_a, minus));
        entry(i, b, direction, cross(r_b, direction));
    }

    /// Sets what your solver computed for row i.
    void answer(int i, double x) { rows_[i].x = x; }

    /// Sets the velocity of a body after the step, with which `lcplab receipts` checks the capture: it must be
    /// u* + inv(M) J^T x.
    void moved(int body, const Vec3& linear, const Vec3& angular) {
        bodies_[body].after = {linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]};
    }

    /// Chooses the friction law: "coupled-box" (|x| <= mu x_n for each row), "coulomb-cone" or "associated-cone", where
    /// each normal row has two rows of friction with one mu. Without a call, coupled-box.
    void model(const std::string& name) { model_ = name; }

    /// Writes the problem, and your answer if a path is given; false if a file cannot be written.
    bool write(const std::string& problem, const std::string& answer = "") const {
        return write_file(problem, &Frame::problem) && (answer.empty() || write_file(answer, &Frame::solution));
    }

private:
    struct Body {
        std::string name;
        double mass;
        Mat3 inertia, inverse;
        Vec3 linear, angular;
        std::vector<double> after; // empty if unknown
    };
    struct Row {
        std::string label, kind;
        double lo, hi, bias, compliance, x;
        int normal;
        double mu;
        std::map<int, Six> entries;
    };

    std::string name_, model_;
    double dt_;
    int bits_;
    std::vector<Body> bodies_;
    std::vector<Row> rows_;

    static Vec3 cross(const Vec3& a, const Vec3& b) {
        return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    }

    static Mat3 inverse(const Mat3& m) {
        const Vec3 c0 = cross(m[1], m[2]), c1 = cross(m[2], m[0]), c2 = cross(m[0], m[1]);
        const double det = m[0][0] * c0[0] + m[0][1] * c0[1] + m[0][2] * c0[2];
        Mat3 out;
        for (int k = 0; k < 3; ++k) out[k] = {{c0[k] / det, c1[k] / det, c2[k] / det}};
        return out;
    }

    bool write_file(const std::string& path, void (Frame::*content)(std::ostream&) const) const {
        std::ofstream out(path.c_str());
        out.imbue(std::locale::classic()); // a point in every country
        out.precision(17);                 // every double is read back with the same bits
        (this->*content)(out);
        out.flush();
        return out.good();
    }

    /// A number; JSON has no others than finite ones, so they are strings, and lcplab reports where they stand.
    static void number(std::ostream& out, double value) {
        if (std::isfinite(value)) out << value;
        else out << (std::isnan(value) ? "\"nan\"" : value > 0 ? "\"inf\"" : "\"-inf\"");
    }

    static void text(std::ostream& out, const std::string& value) {
        out << '"';
        for (std::size_t k = 0; k < value.size(); ++k) {
            const char c = value[k];
            if (c == '"' || c == '\\') out << '\\' << c;
            else if (static_cast<unsigned char>(c) < 0x20) out << ' ';
            else out << c;
        }
        out << '"';
    }

    template <class Items, class Print>
    static void list(std::ostream& out, const char* key, const Items& items, Print print) {
        out << '"' << key << "\":[";
        const char* comma = "";
        for (const auto& item : items) {
            out << comma;
            print(item);
            comma = ",";
        }
        out << ']';
    }

    template <class Value>
    void column(std::ostream& out, const char* key, Value value) const {
        list(out, key, rows_, [&](const Row& row) { number(out, value(row)); });
        out << ",\n";
    }

    static void triplet(std::ostream& out, const char*& comma, std::size_t i, std::size_t j, double value) {
        if (value == 0) return;
        out << comma << '[' << i << ',' << j << ',';
        number(out, value);
        out << ']';
        comma = ",\n";
    }

    /// J_i inv(M) J_j^T.
    double coupled(const Row& one, const Row& other) const {
        double sum = 0;
        for (const auto& own : one.entries) {
            const auto shared = other.entries.find(own.first);
            if (shared == other.entries.end()) continue;
            const Body& body = bodies_[own.first];
            for (int k = 0; k < 3; ++k) {
                sum += own.second[k] * shared->second[k] / body.mass;
                for (int l = 0; l < 3; ++l) sum += own.second[3 + k] * body.inverse[k][l] * shared->second[3 + l];
            }
        }
        return sum;
    }

    /// J_i u* + bias.
    double offset(const Row& row) const {
        double sum = row.bias;
        for (const auto& own : row.entries) {
            const Body& body = bodies_[own.first];
            for (int k = 0; k < 3; ++k) sum += own.second[k] * body.linear[k] + own.second[3 + k] * body.angular[k];
        }
        return sum;
    }

    void problem(std::ostream& out) const {
        out << "{\"name\":";
        text(out, name_);
        out << ",\"source\":{\"engine\":";
        text(out, name_);
        out << ",\"bits\":" << bits_ << "},\n\"A\":{\"rows\":" << rows_.size()
            << ",\"cols\":" << rows_.size() << ",\"triplets\":[";
        const char* comma = "";
        for (std::size_t i = 0; i < rows_.size(); ++i)
            for (std::size_t j = 0; j < rows_.size(); ++j) {
                // One value for both triangles, so that A is symmetric in every bit.
                const double value = i <= j ? coupled(rows_[i], rows_[j]) : coupled(rows_[j], rows_[i]);
                triplet(out, comma, i, j, value + (i == j ? rows_[i].compliance : 0));
            }
        out << "]},\n";
        column(out, "b", [&](const Row& row) { return offset(row); });
        column(out, "lo", [&](const Row& row) { return row.lo; });
        column(out, "hi", [&](const Row& row) { return row.hi; });
        friction(out);
        list(out, "rows", rows_, [&](const Row& row) { named(out, row); });
        out << ",\n";
        if (dt_ > 0) out << "\"dt\":" << dt_ << ",\n";
        motion(out);
        out << "}\n";
    }

    void friction(std::ostream& out) const {
        list(out, "friction_index", rows_, [&](const Row& row) { out << row.normal; });
        out << ",\n";
        column(out, "mu", [&](const Row& row) { return row.mu; });
        if (model_.empty()) return;
        out << "\"model\":";
        text(out, model_);
        out << ",\n";
    }

    void named(std::ostream& out, const Row& row) const {
        out << "{\"label\":";
        text(out, row.label);
        out << ",\"kind\":";
        text(out, row.kind);
        out << ",\"unit\":\"N s\",";
        list(out, "bodies", row.entries, [&](const std::pair<const int, Six>& own) {
            text(out, bodies_[own.first].name);
        });
        out << '}';
    }

    void motion(std::ostream& out) const {
        out << "\"motion\":{\"level\":\"velocity\",\n\"mass\":[";
        const char* comma = "";
        for (std::size_t body = 0; body < bodies_.size(); ++body) {
            for (std::size_t k = 0; k < 3; ++k) triplet(out, comma, 6 * body + k, 6 * body + k, bodies_[body].mass);
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t l = k; l < 3; ++l)
                    triplet(out, comma, 6 * body + 3 + k, 6 * body + 3 + l, bodies_[body].inertia[k][l]);
        }
        out << "],\n\"jacobian\":[";
        comma = "";
        for (std::size_t i = 0; i < rows_.size(); ++i)
            for (const auto& own : rows_[i].entries)
                for (std::size_t k = 0; k < 6; ++k) triplet(out, comma, i, 6 * own.first + k, own.second[k]);
        out << "],\n";
        column(out, "bias", [&](const Row& row) { return row.bias; });
        column(out, "compliance", [&](const Row& row) { return row.compliance; });
        std::vector<double> target;
        for (const Body& body : bodies_) {
            target.insert(target.end(), body.linear.begin(), body.linear.end());
            target.insert(target.end(), body.angular.begin(), body.angular.end());
        }
        list(out, "target", target, [&](double value) { number(out, value); });
        out << '}';
    }

    void solution(std::ostream& out) const {
        out << '{';
        list(out, "x", rows_, [&](const Row& row) { number(out, row.x); });
        std::vector<double> after;
        for (const Body& body : bodies_) after.insert(after.end(), body.after.begin(), body.after.end());
        if (!after.empty()) {
            out << ",\n";
            list(out, "motion", after, [&](double value) { number(out, value); });
        }
        out << "}\n";
    }
};

} // namespace lcplab

#endif
