//! How good is x? One function a measure.
