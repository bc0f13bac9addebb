//! Differences between right pictures: two students who made no mistake may still differ in these
//! choices. Each can be combined with the others and with any mistake.

/// A way of drawing that is not a mistake.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variation {
    /// Adds −1, 0 or 1 grey level to each channel of each pixel, in a fixed pattern.
    pub dirty: bool,
    /// The way in which polygons are filled.
    pub filling: Filling,
    /// The rule for pixels on the edge of a triangle.
    pub edges: Edges,
    /// Draws 2 × 2 samples per pixel and averages them in linear light.
    pub supersampled: bool,
    /// Writes the background with alpha 255 where nothing is drawn, as files without alpha do.
    pub opaque: bool,
}

/// The way in which polygons are filled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filling {
    /// By triangles. Convex polygons become a fan about their first corner.
    #[default]
    Triangles,
    /// By triangles. Convex polygons become a fan about their second corner, so quads have the
    /// other diagonal.
    OtherTriangles,
    /// By scan lines across whole polygons, as the lecture does (L21 3). A student whose mistake is
    /// about triangles still draws triangles.
    ScanLines,
}

/// The rule for which pixels on an edge belong to a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edges {
    /// Pixels whose centre is inside. A centre on an edge counts if it is a top or a left edge.
    #[default]
    TopLeft,
    /// Pixels whose centre is inside. A centre on an edge counts if it is a bottom or a right edge.
    BottomRight,
    /// Corners are rounded to 1/256 pixel first, as many rasterizers do.
    Snapped,
    /// Corners are 0.02 pixels farther right and 0.013 farther down.
    Moved,
}
