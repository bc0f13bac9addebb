//! The sizes that the row engine works in: it draws by them, and bounds of errors are derived from them.

/// Up to this many pixels wide the row engine draws a triangle pixel by pixel, eight triangles at a time.
pub(crate) const TINY_WIDTH: i32 = 5;
/// And up to this many pixels high: its box has no more pixels than an `i32` has bits.
pub(crate) const TINY_HEIGHT: i32 = 6;
/// Barycentric coordinates of a triangle that it draws block by block grow by at most this from pixel to pixel: the triangle is not
/// thinner than a quarter of one.
pub(crate) const STEEPEST: i32 = 4;
/// Scanlines of its tiles: enough to amortise the restart of edges, few enough to give every thread work.
pub(crate) const TILE_HEIGHT: usize = 16;
