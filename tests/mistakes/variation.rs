//! Differences between right pictures: what two students who made no mistake may still do
//! differently. Each can be combined with the others and with any mistake.

/// A way of drawing that is no mistake.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variation {
    /// Adds −1, 0 or 1 grey level to each channel of each pixel, always the same ones.
    pub dirty: bool,
    /// How polygons are filled.
    pub filling: Filling,
    /// Which pixels on the edge of a triangle are its own.
    pub edges: Edges,
    /// Draws 2 × 2 samples per pixel, and takes their mean in linear light.
    pub supersampled: bool,
    /// Writes the background with alpha 255 where nothing is drawn, as files without alpha do.
    pub opaque: bool,
}

/// How polygons are filled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filling {
    /// By triangles, convex polygons as a fan about their first corner.
    #[default]
    Triangles,
    /// By triangles, convex polygons as a fan about their second corner: quads have the other
    /// diagonal.
    OtherTriangles,
    /// By scan lines across whole polygons, as the lecture does (L21 3). Whoever makes a mistake
    /// with triangles draws triangles nevertheless.
    ScanLines,
}

/// Which pixels on an edge belong to a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edges {
    /// Those whose centre is inside; centres on an edge count if it is a top or a left edge.
    #[default]
    TopLeft,
    /// Those whose centre is inside; centres on an edge count if it is a bottom or a right edge.
    BottomRight,
    /// Corners are rounded to 1/256 pixel first, as many rasterizers do.
    Snapped,
    /// Corners are 0.02 pixels farther right and 0.013 farther down.
    Moved,
}
