//! Poses SE(3).
