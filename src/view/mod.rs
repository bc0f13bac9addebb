//! What `fastphong view` shows, without the window: all of it can be tried where there is no display.
//!
//! [`Panes`] are the methods to choose from, those that are shown, and the divider between them. A [`Viewer`] has them and a camera
//! that is turned, and draws into any memory; an [`Action`] is what a key asks of it.

mod action;
mod panes;
mod times;
mod viewer;

pub use action::Action;
pub use panes::{Panes, Side};
pub use times::Times;
pub use viewer::{Loaded, Viewer};
