//! Free fall: z = z0 + v0 t − g t²/2, v = v0 − g t. The scene `free_fall`.

/// A stone thrown upwards.
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
