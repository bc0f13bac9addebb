//! The error of a text that should name something.

use alloc::string::String;
use core::fmt;

/// The reason why a text names nothing that is here, as a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameError(pub(crate) String);

impl fmt::Display for NameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for NameError {}
