//! The viewer of `fastphong view`, without the window, so that it can be tested without a display.
//!
//! [`Panes`] hold the methods to choose from, the ones shown, and the divider between them. A
//! [`Viewer`] has panes and a camera that the user turns, and draws into any memory. An [`Action`]
//! is the meaning of a key.

mod action;
mod panes;
mod times;
mod viewer;

pub use action::Action;
pub use panes::{Panes, Side};
pub use times::Times;
pub use viewer::{Loaded, Viewer};
