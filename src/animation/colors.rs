//! The colors of bodies, ground and forces.

/// Red, green, blue.
type Rgb = (u8, u8, u8);

/// The ground in pictures of scenes.
pub(super) const GROUND: Rgb = (238, 240, 243);
/// Bodies in pictures of scenes: those that are fixed, point masses, and the others in turn.
pub(super) const FIXED: Rgb = (206, 209, 214);
pub(super) const POINT: Rgb = (0, 114, 178);
/// The body that is much heavier than all others.
pub(super) const HEAVY: Rgb = (96, 103, 117);
const BODIES: [Rgb; 6] = [
    (124, 181, 222),
    (238, 180, 92),
    (110, 190, 160),
    (212, 154, 188),
    (226, 214, 124),
    (228, 146, 104),
];

/// The colors for the lowest and the highest value, if color shows a quantity.
const COOL: Rgb = (222, 225, 230);
const HOT: Rgb = (240, 128, 114);

/// The color of a body for this value, from 0 to 1.
pub(super) fn heated(heat: f64) -> Rgb {
    let part = heat.clamp(0.0, 1.0);
    let mixed = |cool: u8, hot: u8| {
        (f64::from(cool) + part * (f64::from(hot) - f64::from(cool))).round() as u8
    };
    (mixed(COOL.0, HOT.0), mixed(COOL.1, HOT.1), mixed(COOL.2, HOT.2))
}

/// The color of the body with this index.
pub(super) fn body_color(index: usize) -> Rgb {
    BODIES[index % BODIES.len()]
}

/// Arrows in pictures of scenes: normal forces, friction, of other constraints, impulses,
/// velocities.
pub(super) const FORCES: [Rgb; 5] =
    [(0, 76, 140), (190, 50, 0), (130, 40, 110), (130, 70, 0), (0, 90, 60)];
