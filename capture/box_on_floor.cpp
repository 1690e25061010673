// A box of 2 kg at rest on a floor for a step of 10 ms, as an engine would write it: each corner carries a quarter.
#include "lcplab_dump.h"

int main() {
    using lcplab::Vec3;
    const double dt = 0.01, g = 9.81, mass = 2, edge = 1, moment = mass * edge * edge / 6;
    lcplab::Frame frame("box on a floor", dt);
    const Vec3 zero = {{0, 0, 0}}, up = {{0, 0, 1}};
    const lcplab::Mat3 inertia = {{{{moment, 0, 0}}, {{0, moment, 0}}, {{0, 0, moment}}}};
    const int box = frame.body("box", mass, inertia, {{0, 0, -g * dt}}, zero);
    for (int corner = 0; corner < 4; ++corner) {
        const Vec3 arm = {{corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, -0.5}};
        const int n = frame.row("normal floor box " + std::to_string(corner), "normal", 0, lcplab::infinity);
        frame.along(n, up, lcplab::fixed_body, zero, box, arm);
        frame.answer(n, mass * g * dt / 4);
        const Vec3 tangents[] = {{{1, 0, 0}}, {{0, 1, 0}}};
        for (const Vec3& tangent : tangents) {
            const int t = frame.friction("friction floor box " + std::to_string(corner), n, 0.5);
            frame.along(t, tangent, lcplab::fixed_body, zero, box, arm);
        }
    }
    frame.moved(box, zero, zero); // the velocity after the step
    return frame.write("frame.json", "frame.x.json") ? 0 : 1;
}
