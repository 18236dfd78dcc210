//! What the constants of a law must be.

use crate::error::{Error, Result};

/// Refuses a constant that is not positive and finite.
pub(super) fn positive(quantity: &'static str, value: f64) -> Result<()> {
    require(value > 0.0 && value.is_finite(), quantity, value, "positive and finite")
}

/// Refuses a constant that does not meet its requirement.
pub(super) fn require(
    met: bool,
    quantity: &'static str,
    value: f64,
    requirement: &'static str,
) -> Result<()> {
    if met { Ok(()) } else { Err(Error::Invalid { quantity, value, requirement }) }
}

/// Refuses a coefficient of a table that does not meet its requirement; `name` is called only then.
pub(super) fn require_coefficient(
    met: bool,
    name: impl FnOnce() -> String,
    value: f64,
    requirement: &'static str,
) -> Result<()> {
    if met { Ok(()) } else { Err(Error::Coefficient { name: name(), value, requirement }) }
}
