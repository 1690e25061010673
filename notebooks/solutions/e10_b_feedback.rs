//! Find the bug 10.b: a pendulum with feedback.
//!
//! A bob of 1 kg hangs on a rod of length l (m) from the origin. Coordinates are x and z (m),
//! gravity g (m/s²) acts along -z, and it starts at rest at `start`. Each step of dt (s) finds the
//! impulse along the rod, and feedback takes the part β of the rod's error out. The program should
//! return the place after so many steps. Its users say: "With dt = 1 s an error goes as it should.
//! With 60 steps a second and β = 0.2 a rod of 1 m gets 20 cm longer while it swings, and when it
//! hangs still, more than a tenth of an error is there after ten seconds." There is exactly one
//! mistake.

/// The place of the bob after the steps.
pub fn answer(start: [f64; 2], l: f64, g: f64, beta: f64, dt: f64, steps: usize) -> [f64; 2] {
    let (mut p, mut u) = (start, [0.0, 0.0]);
    for _step in 0..steps {
        let length = f64::hypot(p[0], p[1]);
        let n = [p[0] / length, p[1] / length];
        let c = length - l;
        u[1] -= dt * g;
        // Along the rod the bob shall move so that c gets smaller: w = n u + feedback + x = 0.
        let x = -(n[0] * u[0] + n[1] * u[1] + beta / dt * c);
        for k in 0..2 {
            u[k] += n[k] * x;
            p[k] += dt * u[k];
        }
    }
    p
}
