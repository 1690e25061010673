//! Free fall: z = z0 + v0 t − g t²/2, v = v0 − g t. The scene `free_fall`.

/// A stone thrown upwards.
///
/// ```
/// use lcplab_mechanics::scene::catalogue::fall::Fall;
///
/// // Thrown up at 10 m/s with g = 10 m/s²: at the top after 1 s, 5 m higher.
/// let stone = Fall { height: 1.0, speed: 10.0, gravity: 10.0 };
/// assert_eq!((stone.speed_after(1.0), stone.height_after(1.0)), (0.0, 6.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// z0 (m).
    pub height: f64,
    /// v0 (m/s), upwards.
    pub speed: f64,
    /// g (m/s²).
    pub gravity: f64,
}

impl Fall {
    /// v (m/s) after a time (s).
    pub fn speed_after(&self, time: f64) -> f64 {
        self.speed - self.gravity * time
    }

    /// z (m) after a time (s).
    pub fn height_after(&self, time: f64) -> f64 {
        self.height + time * (self.speed - 0.5 * self.gravity * time)
    }
}
