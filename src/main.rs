//! The `fastphong` command-line tool.
fn main() {}
