//! The mesh on which what is independent of it is looked at: fine enough, and with any equilibrium for an answer.

use hyperrod::Statics;
use hyperrod::solve::Order;

pub const STATICS: Statics =
    Statics { elements: 64, order: Order::Six, tolerance: 1e-10, accept_unstable: true, ..Statics::DEFAULT };
