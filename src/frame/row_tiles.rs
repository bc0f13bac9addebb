//! The sizes that the row engine works with. It draws by them, and error bounds are derived from
//! them.

/// The largest width, in pixels, of triangles that the row engine draws pixel by pixel, eight
/// triangles at a time.
pub(crate) const TINY_WIDTH: i32 = 5;
/// The largest height, in pixels, of those triangles. Their boxes have no more pixels than an `i32`
/// has bits.
pub(crate) const TINY_HEIGHT: i32 = 6;
/// The largest growth of a barycentric coordinate from pixel to pixel, in triangles that the row
/// engine draws block by block: they are at least a quarter of a pixel thick.
pub(crate) const STEEPEST: i32 = 4;
/// How many scanlines a tile has: enough to amortise the restart of edges, few enough to keep every
/// thread busy.
pub(crate) const TILE_HEIGHT: usize = 16;
