// A stack of three boxes in Box2D 2.4, whose last step is written as a problem file of lcplab.
//
//     g++ -std=c++11 box2d.cpp -lbox2d -o box2d && ./box2d 60 10
//     lcplab judge frame.json frame.x.json --tolerance 1e-5
//
// In your program, copy the struct Capture, add the line that makes one, and call step instead of world.Step. It expects
// contacts without restitution; Box2D's joints are not written. Box2D computes with 32 bits, hence the tolerance.
#include <box2d/box2d.h>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "lcplab_dump.h"

/// Writes each step of a world.
struct Capture : b2ContactListener {
    Capture(b2World& world, const char* problem, const char* answer) : world(world), problem(problem), answer(answer) {
        world.SetContactListener(this);
        world.SetContinuousPhysics(false); // else a second solve may follow at the time of an impact
    }

    void step(float dt, int velocity_sweeps, int position_sweeps) {
        frame = lcplab::Frame("Box2D", dt, 32);
        numbers.clear();
        touching.clear();
        for (const b2Body* body = world.GetBodyList(); body; body = body->GetNext())
            if (body->GetType() == b2_dynamicBody) add_body(*body, dt);
        world.Step(dt, velocity_sweeps, position_sweeps);
        for (const auto& own : numbers)
            frame.moved(own.second, vec(own.first->GetLinearVelocity()), {{0, 0, own.first->GetAngularVelocity()}});
        if (!frame.write(problem, answer)) std::fprintf(stderr, "cannot write %s\n", problem.c_str());
    }

    /// Before the solve: the rows, at the points and poses that the solve takes.
    void PreSolve(b2Contact* contact, const b2Manifold*) override {
        b2WorldManifold points;
        contact->GetWorldManifold(&points);
        const b2Body *a = contact->GetFixtureA()->GetBody(), *b = contact->GetFixtureB()->GetBody();
        for (int k = 0; k < contact->GetManifold()->pointCount; ++k) {
            const int n = frame.row("normal", "normal", 0, lcplab::infinity);
            const int t = frame.friction("friction", n, contact->GetFriction());
            add_entries(n, points.normal, points.points[k], a, b);
            add_entries(t, b2Cross(points.normal, 1.0f), points.points[k], a, b);
            touching[contact][k] = n;
        }
    }

    /// After the solve: its impulses.
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
        for (int k = 0; k < impulse->count; ++k) {
            frame.answer(touching[contact][k], impulse->normalImpulses[k]);
            frame.answer(touching[contact][k] + 1, impulse->tangentImpulses[k]);
        }
    }

private:
    b2World& world;
    std::string problem, answer;
    lcplab::Frame frame;
    std::map<const b2Body*, int> numbers;
    std::map<const b2Contact*, std::map<int, int>> touching;

    static lcplab::Vec3 vec(const b2Vec2& v) { return {{v.x, v.y, 0}}; }

    void add_body(const b2Body& body, double dt) {
        const double moment = body.GetInertia() - body.GetMass() * b2Dot(body.GetLocalCenter(), body.GetLocalCenter());
        // In the plane only the last moment counts.
        const lcplab::Mat3 inertia = {{{{moment, 0, 0}}, {{0, moment, 0}}, {{0, 0, moment}}}};
        const b2Vec2 gravity = float(dt) * body.GetGravityScale() * world.GetGravity();
        const lcplab::Vec3 spin = {{0, 0, body.GetAngularVelocity()}};
        const std::string name = "body " + std::to_string(numbers.size());
        numbers[&body] = frame.body(name, body.GetMass(), inertia, vec(body.GetLinearVelocity() + gravity), spin);
    }

    int number(const b2Body* body) const {
        const auto found = numbers.find(body);
        return found == numbers.end() ? lcplab::fixed_body : found->second;
    }

    void add_entries(int row, const b2Vec2& direction, const b2Vec2& point, const b2Body* a, const b2Body* b) {
        frame.along(row, vec(direction), number(a), vec(point - a->GetWorldCenter()), number(b),
                    vec(point - b->GetWorldCenter()));
    }
};

int main(int argc, char** argv) {
    const int steps = argc > 1 ? std::atoi(argv[1]) : 60, sweeps = argc > 2 ? std::atoi(argv[2]) : 10;
    b2World world(b2Vec2(0, -9.81f));
    b2BodyDef floor_place;
    b2EdgeShape edge;
    edge.SetTwoSided(b2Vec2(-10, 0), b2Vec2(10, 0));
    world.CreateBody(&floor_place)->CreateFixture(&edge, 0);
    for (int k = 0; k < 3; ++k) {
        b2BodyDef place;
        place.type = b2_dynamicBody;
        place.position.Set(0, 0.5f + float(k));
        b2PolygonShape box;
        box.SetAsBox(0.5f, 0.5f);
        world.CreateBody(&place)->CreateFixture(&box, k == 2 ? 10 : 1);
    }
    Capture capture(world, "frame.json", "frame.x.json"); // the added line
    for (int k = 0; k < steps; ++k) capture.step(0.01f, sweeps, 3);
    return 0;
}
